// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/point_strain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/unit/solve/material_cases.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::point_strain_test {

constexpr double side = 20;
const Material tissue{.poisson_ratio = 0.4};

Specimen square(double nodes_per_patch, bool plane_stress) {
  return {test::irregular_rectangle(6, 6, side, side),
          test::rectangle_cells(5, 5, side, side),
          {tissue},
          {.nodes_per_patch = nodes_per_patch, .points_per_cell = 4, .plane_stress = plane_stress}};
}

/// Of all points under u = H·X, H in the plane.
std::vector<PointStrain> strains(Specimen body, const Eigen::Matrix3d& h) {
  body.force(body.linear(h));
  return point_strains(body.points, body.laws, body.scratch);
}

const Eigen::Matrix3d slope{{0.3, 0.1, 0}, {-0.05, -0.1, 0}, {0, 0, 0}};

TEST(PointStrain, IsThatOfTheDeformationAtEveryPoint) {
  const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + slope;
  const Eigen::Matrix2d c = (f.transpose() * f).topLeftCorner<2, 2>();
  const double half = c.trace() / 2;
  const double stretch = std::sqrt(half + std::sqrt(half * half - c.determinant()));
  for (const double nodes_per_patch : {0.0, 6.0}) {
    const auto found = strains(square(nodes_per_patch, false), slope);
    EXPECT_EQ(found.size(), 100U);
    for (const PointStrain& s : found) {
      ASSERT_LE((s.right_cauchy_green - c).norm(), 1e-10);
      ASSERT_NEAR(s.largest_stretch, stretch, 1e-10);
    }
  }
}

TEST(PointStrain, StressInPlaneStrainIsThatOfTheLaw) {
  const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + slope;
  const Eigen::Matrix3d cauchy = stress(elastic_law(tissue), f) * f.transpose() / f.determinant();
  const Eigen::Matrix2d in_plane = cauchy.topLeftCorner<2, 2>();
  const double half = in_plane.trace() / 2;
  const double largest = half + std::sqrt(half * half - in_plane.determinant());
  for (const double nodes_per_patch : {0.0, 6.0}) {
    for (const PointStrain& s : strains(square(nodes_per_patch, false), slope)) {
      ASSERT_NEAR(s.largest_stress, largest, 1e-7 * std::abs(largest));
    }
  }
}

/// Stretched alike both ways in plane stress: with J = λ²λ_3 the law leaves no stress across and the same along both.
TEST(PointStrain, StressInPlaneStressFollowsTheThickness) {
  const Eigen::Matrix3d h = Eigen::Vector3d(0.2, 0.2, 0).asDiagonal();
  const ElasticLaw law = elastic_law(tissue);
  double low = 0.3, high = 1.5;
  while (high - low > 1e-13) {
    const double thickness = (low + high) / 2;
    (stress(law, Eigen::Vector3d(1.2, 1.2, thickness).asDiagonal())(2, 2) > 0 ? high : low) = thickness;
  }
  const double largest = stress(law, Eigen::Vector3d(1.2, 1.2, low).asDiagonal())(0, 0) / (1.2 * low);
  for (const PointStrain& s : strains(square(0, true), h)) {
    ASSERT_NEAR(s.largest_stretch, 1.2, 1e-10);
    ASSERT_NEAR(s.largest_stress, largest, 1e-6 * largest);
  }
}

TEST(PointStrain, OfARotationIsNone) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (const PointStrain& s : strains(square(6, false), turn - Eigen::Matrix3d::Identity())) {
    ASSERT_LE((s.right_cauchy_green - Eigen::Matrix2d::Identity()).norm(), 1e-10);
    ASSERT_NEAR(s.largest_stretch, 1, 1e-10);
    ASSERT_NEAR(s.largest_stress, 0, 1e-6);
  }
}

}  // namespace brainshift::solve::point_strain_test
