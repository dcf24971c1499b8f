// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/near_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::solve::near_surface_test {

using brainshift::test::expect_parts;

Points ball(const Eigen::Vector3d& centre) {
  return brainshift::test::sphere(centre, 60, 4).vertices;
}

/// The cap of a ball of another radius about the same centre, seen from the left.
Points cap(const Eigen::Vector3d& centre, double radius) {
  const Points all = brainshift::test::sphere(centre, radius, 3).vertices;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index v = 0; v < all.rows(); ++v) {
    if (all(v, 0) - centre.x() > 0.8 * radius) {
      rows.push_back(v);
    }
  }
  return all(rows, Eigen::all);
}

std::string refusal(const Points& measured, const Points& surface) {
  try {
    check_near_surface(measured, surface, 20);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(NearSurface, PointsInTheOtherFrameAreToldEvenWhereNoneIsFarOff) {
  const Eigen::Vector3d centre(6, 4, 30);
  Points turned = cap(centre, 60);
  turned.leftCols(2) *= -1;
  const std::string far_off = refusal(turned, ball(centre));
  expect_parts(far_off, {"x and y flipped", "RAS", "correct the frame"});
  // No point is farther off than is allowed, so only the comparison tells.
  Points near = cap({8, 0, 0}, 60);
  near.leftCols(2) *= -1;
  expect_parts(refusal(near, ball({8, 0, 0})), {"x and y flipped", "farthest 1"});
}

TEST(NearSurface, PointsThatLieOffTheSurfaceInBothFramesAreNotToldToBeTurned) {
  EXPECT_EQ(refusal(cap({0, 0, 0}, 60), ball({0, 0, 0})), "");
  EXPECT_EQ(refusal(cap({0, 0, 0}, 72), ball({0, 0, 0})), "");
  const std::string far = refusal(cap({0, 0, 0}, 85), ball({0, 0, 0}));
  expect_parts(far, {"measured point", "20.0 mm are allowed", "same frame"});
  EXPECT_EQ(far.find("RAS"), std::string::npos) << far;
}

TEST(NearSurface, OfPointsThatMayLieInsideTheFrameAndTheUnitAreTold) {
  const Eigen::Vector3d centre(6, 4, 30);
  const auto fault = [&](const Points& measured) {
    return test::refusal([&] { check_frame(measured, ball(centre), 20); });
  };
  Points turned = cap(centre, 60);
  EXPECT_EQ(fault(turned), "");
  EXPECT_EQ(fault(cap(centre, 30)), "") << "they lie inside";
  turned.leftCols(2) *= -1;
  expect_parts(fault(turned), {"x and y flipped", "RAS"});
  expect_parts(fault(cap(centre, 60) / 1000), {"within a millimetre", "in mm are expected"});
}

TEST(NearSurface, PointsThatNoLoadedNodeIsNearAreCounted) {
  NodeCloud cloud;
  cloud.positions = ball({0, 0, 0});
  cloud.spacing.assign(static_cast<std::size_t>(cloud.positions.rows()), 4);
  cloud.on_surface.assign(static_cast<std::size_t>(cloud.positions.rows()), 1);
  const Points left = cap({0, 0, 0}, 60);
  Points prescribed = Points::Constant(cloud.positions.rows(), 3, std::nan(""));
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (cloud.positions(a, 0) > 45) {
      prescribed.row(a).setZero();
    }
  }
  EXPECT_EQ(share_not_taken(left, cloud, prescribed), 0);
  EXPECT_EQ(share_not_taken(-left, cloud, prescribed), 1);
  EXPECT_EQ(test::refusal([&] { check_taken(left, cloud, prescribed); }), "");
  expect_parts(test::refusal([&] { check_taken(cloud.positions, cloud, prescribed); }), {"one opening"});
}

}  // namespace brainshift::solve::near_surface_test
