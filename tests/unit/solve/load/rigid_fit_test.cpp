// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/rigid_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/read_rigid.hpp"

namespace brainshift::solve::rigid_fit_test {

RigidMotion turned() {
  RigidMotion motion;
  motion.rotation = Eigen::AngleAxisd(0.09, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  motion.translation << 5, -3, 1;
  return motion;
}

TEST(RigidFit, FindsTheMotionOfPlacesThatMovedAsOne) {
  const Points places = test::random_points(7, 80);
  const RigidMotion motion = turned(), found = fit_rigid(places, motion(places), Points(0, 3));
  EXPECT_LT((found.rotation - motion.rotation).norm(), 1e-12);
  EXPECT_LT((found.translation - motion.translation).norm(), 1e-10);
  EXPECT_NEAR(found.angle(), 0.09 * 180 / 3.14159265358979, 1e-9);
  EXPECT_LT((motion.back(motion(places)) - places).norm(), 1e-10);
}

TEST(RigidFit, HeedsAPlaceByItsVarianceAndIsNoReflection) {
  const Points places = test::random_points(5, 80);
  Points moved = turned()(places), sigma = Points::Ones(5, 3);
  moved.row(2) += Eigen::RowVector3d(30, 0, 0);
  sigma.row(2).setConstant(1e4);
  EXPECT_LT((fit_rigid(places, moved, sigma).rotation - turned().rotation).norm(), 1e-6);
  Points mirrored = places;
  mirrored.col(0) *= -1;
  EXPECT_NEAR(fit_rigid(places, mirrored, Points(0, 3)).rotation.determinant(), 1, 1e-12);
}

TEST(RigidFit, LeavesTheDisplacementInTheFrameOfTheImage) {
  const Points places = test::random_points(5, 80), u = test::random_points(5, 3);
  const CraniotomyLoad seen{places, turned()(places + u) - places, Points::Ones(5, 3)};
  const CraniotomyLoad load = registered(seen, turned());
  EXPECT_LT((load.displacement - u).norm(), 1e-10);
  EXPECT_EQ(load.positions, places);
}

/// The tracker's z is the image's y after a quarter turn about x.
TEST(RigidFit, TurnsDeviationsWithTheDisplacement) {
  const RigidMotion quarter{
      .rotation = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix(),
      .translation = Eigen::Vector3d(3, 2, 1)};
  const Points places = test::random_points(4, 80);
  Points sigma = Points::Constant(4, 3, 0.3);
  sigma.col(2).setConstant(3);
  const CraniotomyLoad load = registered({places, quarter(places) - places, sigma}, quarter);
  for (Eigen::Index i = 0; i < 4; ++i) {
    EXPECT_LT((load.sigma.row(i) - Eigen::RowVector3d(0.3, 3, 0.3)).norm(), 1e-9);
  }
  EXPECT_EQ(registered({places, turned()(places) - places, sigma}, turned()).sigma, sigma)
      << "little turned, a component that nobody measured spoils no other";
  EXPECT_EQ(registered({places, places, Points(0, 3)}, quarter).sigma.rows(), 0);
}

TEST(RigidFit, IsWrittenAsAnItkTransform) {
  const test::ScratchFolder folder;
  write_rigid(folder / "t.tfm", turned());
  std::ifstream stream(folder / "t.tfm");
  std::stringstream text;
  text << stream.rdbuf();
  EXPECT_TRUE(text.str().starts_with("#Insight Transform File V1.0\n"));
  EXPECT_NE(text.str().find("AffineTransform_double_3_3\nParameters: "), std::string::npos);
  EXPECT_LT((test::read_rigid(folder / "t.tfm").rotation - turned().rotation).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NE(text.str().find(" 5 -3  1\nFixedParameters: 0 0 0\n"), std::string::npos) << text.str();
}

}  // namespace brainshift::solve::rigid_fit_test
