// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/viewer_data.hpp"

#include <gtest/gtest.h>

#include <openssl/evp.h>
#include <zlib.h>

#include <Eigen/Geometry>
#include <random>

#include "tests/unit/pipelines/report/small_run.hpp"

namespace brainshift::pipelines::viewer_data_test {

using Eigen::Vector3d;

constexpr std::size_t room = 5'000'000;

/// small_run() with all that the stages leave.
RunData full_run() {
  RunData run = small_run();
  const std::size_t voxels = run.t1->voxels.size();
  run.forward = VectorImage{run.t1->geometry, std::vector<std::array<float, 3>>(voxels, {1, -2, 3.5})};
  run.jacobian = ScalarImage{run.t1->geometry, std::vector<float>(voxels, 0.9F)};
  run.labels = run.warped_labels = LabelMap{run.t1->geometry, std::vector<std::uint16_t>(voxels, 1024)};
  for (float& value : run.warped->voxels) {
    value += 5;
  }
  run.solution->estimated_error.assign(run.solution->spacing.size(), 0.25);
  return run;
}

template <class T>
std::vector<T> numbers(const ViewerData& data, const std::string& name) {
  const auto found = std::ranges::find(data.arrays, name, &PackedBytes::name);
  if (found == data.arrays.end()) {
    return {};
  }
  std::vector<unsigned char> compressed(found->text.size());
  EVP_DecodeBlock(compressed.data(), reinterpret_cast<const unsigned char*>(found->text.data()),
                  static_cast<int>(found->text.size()));
  std::vector<T> result(10'000'000 / sizeof(T));
  uLongf size = 10'000'000;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(result.data()), &size, compressed.data(), compressed.size()), Z_OK);
  result.resize(size / sizeof(T));
  return result;
}

Vector3d transformed(const nlohmann::json& matrix, const Vector3d& place) {
  const auto m = matrix.get<std::vector<double>>();
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(m.data()) * place.homogeneous();
}

TEST(ViewerData, HoldsTheBrainAndTenMillimetresAroundIt) {
  RunData run = full_run();
  run.t1->geometry.direction << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  run.t1->geometry.origin = {29, -29, -29};
  run.warped->geometry = run.t1->geometry;
  const ViewerData data = viewer_data(run, make_view(run), room);
  const nlohmann::json& grid = data.facts["images"];
  const auto size = grid["size"].get<std::vector<int>>();
  EXPECT_EQ(size, (std::vector<int>{30, 30, 30})) << "the image ends 9 mm from the brain";
  const Vector3d corner = transformed(grid["to_world"], {0, 29, 0});
  EXPECT_TRUE(corner.isApprox(Vector3d(-29, -29, -29))) << corner.transpose();
  EXPECT_TRUE(transformed(grid["to_index"], corner).isApprox(Vector3d(0, 29, 0), 1e-9));
  run.brain->vertices *= 0.25;
  EXPECT_EQ(viewer_data(run, make_view(run), room).facts["images"]["size"][0], 16)
      << "10 + 10 mm, and one voxel cut at each";
}

TEST(ViewerData, TheWarpedImageIsTheFirstAndWhatChanged) {
  const RunData run = full_run();
  const View view = make_view(run);
  const ViewerData data = viewer_data(run, view, room);
  const auto before = numbers<std::uint8_t>(data, "image"), change = numbers<std::uint8_t>(data, "image_change");
  ASSERT_EQ(before.size(), run.t1->voxels.size());
  ASSERT_EQ(change.size(), before.size());
  for (std::size_t voxel = 0; voxel < before.size(); ++voxel) {
    const double shown =
        252 * std::min(1.0, (run.warped->voxels[voxel] - view.darkest) / (view.brightest - view.darkest));
    EXPECT_NEAR(static_cast<std::uint8_t>(before[voxel] + change[voxel]), shown, 2.01);
    EXPECT_EQ(before[voxel] % 4, 0);
  }
}

TEST(ViewerData, FieldsAreInWholeSteps) {
  const RunData run = full_run();
  const ViewerData data = viewer_data(run, make_view(run), room);
  const auto u = numbers<std::int16_t>(data, "displacement");
  const auto brain = numbers<std::uint8_t>(data, "brain");
  ASSERT_EQ(u.size(), 3 * brain.size());
  const double step = data.facts["steps"]["displacement"];
  EXPECT_NEAR(step * u.front(), 1, step);
  EXPECT_NEAR(step * u[brain.size()], -2, step);
  EXPECT_NEAR(step * u.back(), 3.5, step);
  EXPECT_NEAR(numbers<std::int16_t>(data, "ratio")[7] * data.facts["steps"]["ratio"].get<double>(), 0.9, 1e-3);
  const auto error = numbers<std::int16_t>(data, "error");
  EXPECT_NEAR(*std::ranges::max_element(error) * data.facts["steps"]["error"].get<double>(), 0.25, 5e-3);
  EXPECT_EQ(error[7], 0) << "far from every node there is none";
  EXPECT_EQ(std::ranges::count(brain, 1), 20 * 20 * 20) << "voxels of 2 mm in the cube of 40";
  EXPECT_EQ(numbers<std::uint16_t>(data, "labels_after")[5], 1024);
  EXPECT_EQ(numbers<float>(data, "vertices").size(), static_cast<std::size_t>(run.brain->vertices.size()));
  EXPECT_EQ(numbers<std::int32_t>(data, "triangles")[5], run.brain->triangles(1, 2));
}

TEST(ViewerData, LeavesOutWhatTheRunDidNotMake) {
  RunData run = full_run();
  run.jacobian.reset();
  run.warped_labels.reset();
  run.solution->estimated_error.clear();
  const ViewerData data = viewer_data(run, make_view(run), room);
  EXPECT_EQ(data.facts["steps"].size(), 1U) << data.facts["steps"];
  for (const char* name : {"ratio", "error", "labels", "labels_after"}) {
    EXPECT_EQ(std::ranges::count(data.arrays, name, &PackedBytes::name), 0) << name;
  }
}

TEST(ViewerData, ALargeImageIsMadeCoarserUntilThePageIsSmall) {
  RunData run = full_run();
  run.t1->geometry.size = {150, 150, 150};
  run.t1->geometry.spacing = {0.4, 0.4, 0.4};
  std::mt19937 random;  // noise: nothing compresses worse
  run.t1->voxels.resize(run.t1->geometry.voxel_count());
  std::ranges::generate(run.t1->voxels, [&] { return static_cast<float>(random() % 100); });
  run.warped = run.t1;
  std::ranges::shuffle(run.warped->voxels, random);
  const ViewerData data = viewer_data(run, make_view(run), room);
  EXPECT_LE(letters_of(data.arrays), room);
  EXPECT_GT(letters_of(data.arrays), room / 3) << "no coarser than it must be";
  const Vector3d last = transformed(data.facts["images"]["to_world"], Vector3d::Ones());
  EXPECT_GT((last - transformed(data.facts["images"]["to_world"], Vector3d::Zero())).x(), 0.4);
  EXPECT_LT(letters_of(viewer_data(run, make_view(run), 0).arrays), 600'000U) << "no room at all";
}

}  // namespace brainshift::pipelines::viewer_data_test
