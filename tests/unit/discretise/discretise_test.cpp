// SPDX-License-Identifier: GPL-3.0-or-later

#include "discretise/discretise.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::discretise_test {

using test::ball;
using test::ball_labels;
using test::box;
using test::bumpy_brain;
using test::refusal;
using test::with_nodes;
const Eigen::Vector3d centre(30, -210, 55);

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(Discretise, MeetsTheAskedNumberOfNodes) {
  const Surface brain = bumpy_brain();
  for (const std::size_t nodes : {300U, 2000U, 6000U}) {
    const Discretisation result = with_nodes(brain, nodes);
    EXPECT_NEAR(static_cast<double>(result.cloud.size()), static_cast<double>(nodes),
                0.05 * static_cast<double>(nodes));
    EXPECT_EQ(result.measures.nodes, result.cloud.size());
  }
}

TEST(Discretise, MeetsTheAskedSpacing) {
  DiscretiseOptions options;
  options.spacing = 7.0;
  const Discretisation result = discretise(bumpy_brain(), nullptr, options);
  EXPECT_NEAR(mean(result.cloud.spacing), 7.0, 0.05 * 7.0);
  EXPECT_EQ(result.measures.spacing, 7.0);
}

TEST(Discretise, LeavesNoVoidForASupport) {
  const Surface surface = ball(50, centre, 4);
  const Discretisation result = with_nodes(surface, 3000);
  const Points& x = result.cloud.positions;
  std::size_t fewest = x.rows();
  for (int i = 0; i < 2000; ++i) {
    const double r = 49.5 * std::cbrt((i + 0.5) / 2000);
    const double z = 1 - 2 * std::fmod(i * 0.618033988749895, 1.0);
    const double angle = 2.399963 * 7 * i;
    const double flat = std::sqrt(1 - z * z);
    const Eigen::RowVector3d place =
        centre.transpose() + r * Eigen::RowVector3d(flat * std::cos(angle), flat * std::sin(angle), z);
    std::size_t support = 0;
    for (Eigen::Index node = 0; node < x.rows(); ++node) {
      support += (x.row(node) - place).norm() < 1.6 * result.cloud.spacing[static_cast<std::size_t>(node)] ? 1 : 0;
    }
    fewest = std::min(fewest, support);
  }
  EXPECT_GE(fewest, 10U);
}

TEST(Discretise, IsTheSameFilesForTheSameSeedAndAnyNumberOfThreads) {
  const test::ScratchFolder folder;
  const LabelMap labels = ball_labels(centre, 15, 40);
  const Surface surface = ball(38, centre, 4);
  const auto run = [&](const std::string& name, std::uint64_t seed, int threads) {
    DiscretiseOptions options;
    options.nodes = 1500;
    options.seed = seed;
    options.tumour_factor = 0.6;
    std::filesystem::create_directory(folder / name);
    omp_set_num_threads(threads);
    write_discretisation(folder / name, discretise(surface, &labels, options));
    return test::bytes_of(folder / (name + "/nodes.vtu")) + test::bytes_of(folder / (name + "/cells.vtu"));
  };
  const int threads = omp_get_max_threads();
  const std::string first = run("a", 1, 1);
  EXPECT_EQ(first, run("b", 1, 3));
  EXPECT_NE(first, run("c", 2, 1));
  omp_set_num_threads(threads);
}

TEST(Discretise, GivesTheTissueOfTheVoxelOrOfTheNearestOfTheBrain) {
  // The surface reaches 3 mm farther than the labels: there the nearest brain voxel is of tissue 1.
  const LabelMap labels = ball_labels(centre, 20, 37);
  DiscretiseOptions options;
  options.nodes = 2000;
  const Discretisation result = discretise(ball(40, centre, 4), &labels, options);
  double inner = 0, all = 0;
  for (std::size_t cell = 0; cell < result.cells.size(); ++cell) {
    const std::int32_t* corner = &result.cells.connectivity[8 * cell];
    const Eigen::RowVector3d low = result.cells.vertices.row(corner[0]), high = result.cells.vertices.row(corner[6]);
    const double distance = ((low + high) / 2 - centre.transpose()).norm();
    const double volume = result.cells.inside_fraction[cell] * (high - low).prod();
    EXPECT_TRUE(result.cells.label[cell] == 1 || result.cells.label[cell] == 3);
    if (std::abs(distance - 20) > 1) {
      EXPECT_EQ(result.cells.label[cell], distance < 20 ? 3 : 1);
    }
    inner += result.cells.label[cell] == 3 ? volume : 0;
    all += volume;
  }
  EXPECT_NEAR(inner / all, 1.0 / 8, 0.03);
}

TEST(Discretise, IsReallyFinerTowardsACraniotomy) {
  DiscretiseOptions options;
  options.nodes = 4000;
  options.craniotomy = Refinement{.centres = Points(1, 3), .radius = 20, .factor = 0.5};
  options.craniotomy->centres.row(0) = centre.transpose() + Eigen::RowVector3d(0, 50, 0);
  const Discretisation result = discretise(ball(50, centre, 4), nullptr, options);
  std::vector<double> near;
  std::vector<double> far;
  for (std::size_t node = 0; node < result.cloud.size(); ++node) {
    const double distance =
        (result.cloud.positions.row(static_cast<Eigen::Index>(node)) - options.craniotomy->centres.row(0)).norm();
    if (distance < 15 || distance > 45) {
      (distance < 15 ? near : far).push_back(result.cloud.spacing[node]);
    }
  }
  EXPECT_NEAR(mean(near) / mean(far), 0.5, 0.06);
  EXPECT_GE(result.measures.smallest_distance_ratio, 0.5);
  EXPECT_NEAR(static_cast<double>(result.cloud.size()), 4000.0, 200.0);
  EXPECT_NEAR(result.measures.cells_inside_volume / result.measures.surface_volume, 1.0, 2e-3);
}

TEST(Discretise, IsReallyFinerInATumourAndAtATissueBoundary) {
  const LabelMap labels = ball_labels(centre, 15, 41);
  DiscretiseOptions options;
  options.nodes = 3000;
  const auto spacings = [&](double from, double to) {
    const Discretisation result = discretise(ball(40, centre, 4), &labels, options);
    std::vector<double> spacing;
    for (std::size_t node = 0; node < result.cloud.size(); ++node) {
      const double r = (result.cloud.positions.row(static_cast<Eigen::Index>(node)) - centre.transpose()).norm();
      if (r >= from && r < to) {
        spacing.push_back(result.cloud.spacing[node]);
      }
    }
    return mean(spacing) / result.measures.spacing;
  };
  options.tumour_factor = 0.6;
  EXPECT_NEAR(spacings(0, 14), 0.6, 0.08);
  options.tumour_factor = 1;
  options.tissue_boundary_factor = 0.6;
  EXPECT_NEAR(spacings(14, 16), 0.65, 0.08);
  EXPECT_GT(spacings(28, 36), 0.9);
}

TEST(Discretise, RefusesOptionsBeforeAllElse) {
  EXPECT_NE(refusal([] { discretise({}, nullptr, {.spacing = 5.0, .nodes = 500}); }).find("give one"),
            std::string::npos);
}

TEST(Discretise, RefusesASurfaceThatEnclosesNoBody) {
  const auto refused = [](const Surface& surface) { return refusal([&] { with_nodes(surface, 500); }); };
  Surface bad = ball(40, centre, 3);
  bad.triangles.conservativeResize(bad.triangles.rows() - 1, 3);
  EXPECT_NE(refused(bad).find("open"), std::string::npos);
  bad = ball(40, centre, 3);
  bad.triangles.col(0).swap(bad.triangles.col(1));
  EXPECT_NE(refused(bad).find("inside out"), std::string::npos);
  bad = ball(40, centre, 3);
  bad.vertices.row(0) = centre.transpose() - Eigen::RowVector3d(60, 0, 0);
  EXPECT_NE(refused(bad).find("intersects itself"), std::string::npos);
  bad = ball(40, centre, 3);
  bad.triangles.row(5).reverseInPlace();
  EXPECT_NE(refused(bad).find("manifold"), std::string::npos);
  bad = ball(40, centre, 3);
  bad.vertices(7, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused(bad).find("vertex 7"), std::string::npos);
  EXPECT_NE(refused(Surface{}).find("triangles"), std::string::npos);
}

TEST(Discretise, RefusesLabelsThatLieElsewhere) {
  const LabelMap flipped = ball_labels({-centre.x(), -centre.y(), centre.z()}, 15, 40);
  DiscretiseOptions options;
  options.nodes = 500;
  EXPECT_NE(refusal([&] { discretise(ball(38, centre, 3), &flipped, options); }).find("different frames"),
            std::string::npos);
  options.brain_labels = {7};
  EXPECT_NE(refusal([&] { discretise(ball(38, centre, 3), &flipped, options); }).find("brain label"),
            std::string::npos);
}

}  // namespace brainshift::discretise::discretise_test
