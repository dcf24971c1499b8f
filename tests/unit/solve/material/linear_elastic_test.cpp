// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/linear_elastic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "solve/material/elastic_law.hpp"
#include "tests/unit/solve/material_cases.hpp"

namespace brainshift::solve::linear_elastic_test {

/// The limit of the law: a rotation by 0.1 rad, which strains nothing, stresses as half a percent of compression does.
TEST(LinearElastic, TakesARotationForACompression) {
  const ElasticLaw law = elastic_law({.law = Law::linear_elastic});
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(dilatation(law, rotation), 2 * (std::cos(0.1) - 1), 1e-15);
  EXPECT_LT(stress(law, rotation).trace() / 3, -0.009 * std::get<LinearElastic>(law).bulk_modulus);
  EXPECT_GT(isochoric_stress(law, rotation).norm(), 0.008 * std::get<LinearElastic>(law).shear_modulus);
}

}  // namespace brainshift::solve::linear_elastic_test
