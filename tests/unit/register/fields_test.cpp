// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/registration.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/LU>
#include <algorithm>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::fields_test {

using namespace builders;

constexpr double rounding = 2.2e-4;  // of the stored displacement: half of 1/4096 mm in each component

TEST(Fields, AreZeroWhereNothingMoves) {
  const Registration result = register_images(head([](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); }), {});
  const std::array<float, 3> zero{0, 0, 0};
  EXPECT_EQ(std::count(result.forward.voxels.begin(), result.forward.voxels.end(), zero),
            static_cast<std::ptrdiff_t>(result.forward.voxels.size()));
  EXPECT_EQ(std::count(result.resampling.voxels.begin(), result.resampling.voxels.end(), zero),
            static_cast<std::ptrdiff_t>(result.resampling.voxels.size()));
  EXPECT_EQ(result.measures.moved_voxels, 0U);
  EXPECT_EQ(result.measures.jacobian_min, 1);
}

TEST(Fields, AreTheSameInTheWorldOnAnObliqueGrid) {
  // Everything turned about the brain's centre: the same voxels must move by the turned displacement.
  const Eigen::Matrix3d turn = oblique();
  const auto turned = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return centre + turn * (x - centre); };
  const RegisterInput straight = head(sinking);
  RegisterInput input = straight;
  input.t1.geometry = input.labels->geometry = grid(straight.t1.geometry.size, straight.t1.geometry.spacing, turn);
  for (Points* points : {&input.solution.positions, &input.brain.vertices}) {
    for (Eigen::Index p = 0; p < points->rows(); ++p) {
      points->row(p) = turned(points->row(p)).transpose();
    }
  }
  input.solution.displacement = straight.solution.displacement * turn.transpose();
  const Registration expected = register_images(straight, {}), result = register_images(input, {});
  double in_brain = 0, anywhere = 0, image_in_brain = 0;
  for_each_voxel(straight.t1.geometry, [&](const Eigen::Vector3d& x, std::size_t v) {
    const double off = (at(result.forward, v) - turn * at(expected.forward, v)).norm() +
                       (at(result.resampling, v) - turn * at(expected.resampling, v)).norm();
    anywhere = std::max(anywhere, off);
    if ((x - centre).norm() < 0.6 * radius) {
      in_brain = std::max(in_brain, off);
      const double grey = std::abs(result.warped.voxels[v] - expected.warped.voxels[v]);
      image_in_brain = std::max(image_in_brain, grey);
    }
  });
  EXPECT_LT(in_brain, 4 * rounding);
  EXPECT_LT(image_in_brain, 0.05);
  EXPECT_LT(anywhere, 0.5);  // outside: the distance is sampled on a grid that does not turn with the head
}

TEST(Fields, DoNotDependOnTheNumberOfThreads) {
  const RegisterInput input = head(sinking);
  RegisterOptions options;
  options.interpolation = Interpolation::bspline;
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Registration one = register_images(input, options);
  omp_set_num_threads(3);
  const Registration three = register_images(input, options);
  omp_set_num_threads(before);
  EXPECT_EQ(one.forward.voxels, three.forward.voxels);
  EXPECT_EQ(one.resampling.voxels, three.resampling.voxels);
  EXPECT_EQ(one.warped.voxels, three.warped.voxels);
  EXPECT_EQ(one.warped_labels->voxels, three.warped_labels->voxels);
  EXPECT_EQ(one.measures.inverse_mean, three.measures.inverse_mean);
}

}  // namespace brainshift::registration::fields_test
