// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/cavity_voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "register/files/warp_any.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::cavity_voxels_test {

using namespace builders;

constexpr double inner = 10;

RegisterInput hollow_head(const DisplacementOf& displacement) {
  RegisterInput input = head(displacement);
  input.cavity = Cavity{ball(centre, inner), {2}};
  std::vector<Eigen::Index> left;
  for (Eigen::Index a = 0; a < input.solution.positions.rows(); ++a) {
    if ((input.solution.positions.row(a).transpose() - centre).norm() > inner) {
      left.push_back(a);
    }
  }
  Solution& s = input.solution;
  s = {Points(s.positions(left, Eigen::all)), Points(s.displacement(left, Eigen::all)),
       Points(s.reaction_force(left, Eigen::all)), std::vector<double>(left.size(), s.spacing.front()), s.shape};
  return input;
}

TEST(CavityVoxels, DrawNoTissue) {
  RegisterInput input = hollow_head(sinking);
  RegisterOptions options;
  options.cavity_label = 24;
  options.cavity_value = 17;
  const Registration result = register_images(input, options);
  EXPECT_EQ(std::ranges::count(result.warped_labels->voxels, 2), 0);
  EXPECT_GT(result.measures.cavity_voxels, 0U);
  std::size_t drawn = 0;
  for_each_voxel(input.t1.geometry, [&](const Eigen::Vector3d& y, std::size_t v) {
    const Eigen::Vector3d x = y + at(result.resampling, v);
    if ((x - centre).norm() < inner - 4) {
      EXPECT_EQ(result.warped.voxels[v], 17);
      EXPECT_EQ(result.warped_labels->voxels[v], 24);
      ++drawn;
    }
    if ((x - centre).norm() > inner + 4) {
      EXPECT_NE(result.warped_labels->voxels[v], 24);
    }
  });
  EXPECT_GT(drawn, 0U);
  EXPECT_EQ(result.measures.folded_voxels, 0U);
}

/// As of a run's own images, so of other files that are taken along.
TEST(CavityVoxels, AreEmptyInOtherFilesToo) {
  const RegisterInput input = hollow_head(sinking);
  const Registration result = register_images(input, {});
  const test::ScratchFolder folder;
  write_registration(folder.path(), result);
  write_image(folder / "labels.nii.gz", *input.labels);
  write_image(folder / "t1.nii.gz", input.t1);
  std::ostringstream points;
  points << "# frame: LPS\nx,y,z\n"
         << centre.x() << ',' << centre.y() << ',' << centre.z() << '\n'
         << centre.x() << ',' << centre.y() << ',' << centre.z() + inner + 6 << '\n';
  folder.write("points.csv", points.str());
  RegisterFields fields(folder.path(), Towards::intraop);
  const WarpedFile labels = warp_any(folder / "labels.nii.gz", fields, folder / "out_labels.nii.gz");
  EXPECT_EQ(labels.removed, result.measures.cavity_voxels);
  EXPECT_EQ(std::ranges::count(read_label_map(folder / "out_labels.nii.gz").voxels, 2), 0);
  warp_any(folder / "t1.nii.gz", fields, folder / "out_t1.nii.gz");
  const ScalarImage t1 = read_image(folder / "out_t1.nii.gz");
  for (std::size_t v = 0; v < t1.voxels.size(); ++v) {
    EXPECT_NEAR(t1.voxels[v], result.warped.voxels[v], 1e-3) << v;
  }
  EXPECT_EQ(warp_any(folder / "points.csv", fields, folder / "out_points.csv").moved.removed, 1U);
  RegisterFields back(folder.path(), Towards::preop);
  EXPECT_EQ(warp_any(folder / "labels.nii.gz", back, folder / "back_labels.nii.gz").removed, 0U);
}

TEST(CavityVoxels, LeaveTheTissueAroundWhereTheSolverPutIt) {
  const auto collapse = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    const Eigen::Vector3d out = x - centre;
    const double r = std::max(out.norm(), inner);
    return -3 * std::pow(inner / r, 2) * out / r;
  };
  RegisterInput input = hollow_head(collapse);
  input.landmarks.resize(3, 3);
  input.landmarks << centre.x() + inner + 0.5, centre.y(), centre.z(),  //
      centre.x(), centre.y() - inner - 0.5, centre.z(),                 //
      centre.x() + 1, centre.y(), centre.z();
  const Registration result = register_images(input, {});
  EXPECT_EQ(result.measures.cavity_landmarks, 1U);
  for (int p = 0; p < 2; ++p) {
    const Eigen::Vector3d x = input.landmarks.row(p);
    EXPECT_LT((result.landmarks.row(p).transpose() - x - collapse(x)).norm(), 0.3);
  }
  EXPECT_EQ(result.measures.folded_voxels, 0U);
  EXPECT_LT(result.measures.fit_error, 0.3);
}

}  // namespace brainshift::registration::cavity_voxels_test
