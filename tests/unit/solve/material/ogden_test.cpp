// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/ogden.hpp"

#include <gtest/gtest.h>

#include "solve/material/elastic_law.hpp"
#include "tests/unit/solve/material_cases.hpp"

namespace brainshift::solve::ogden_test {

TEST(Ogden, WithTheExponentTwoIsNeoHookean) {
  const Material brain;
  const ElasticLaw neo_hookean = elastic_law(brain);
  const double mu = shear_modulus(brain);
  const ElasticLaw ogden = elastic_law({.law = Law::ogden, .ogden = {{0.3 * mu, 2}, {0.7 * mu, 2}}});
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d f = random_deformation(seed);
    EXPECT_LE((stress(ogden, f) - stress(neo_hookean, f)).norm(), 1e-11 * stress(neo_hookean, f).norm());
    EXPECT_NEAR(energy(ogden, f), energy(neo_hookean, f), 1e-11 * energy(neo_hookean, f));
    const double p = pressure(ogden, f);
    EXPECT_NEAR(largest_tangent(std::get<Ogden>(ogden), f, p), largest_tangent(std::get<NeoHookean>(neo_hookean), f, p),
                1e-10 * bulk_modulus(brain));
  }
}

TEST(Ogden, TakesAsManyTermsAsItHasRoomFor) {
  Material material{.law = Law::ogden};
  EXPECT_THROW(Ogden{material}, std::invalid_argument);
  material.ogden.assign(Ogden::capacity, {100, 3});
  EXPECT_EQ(Ogden(material).terms().size(), Ogden::capacity);
  material.ogden.push_back({100, 3});
  EXPECT_THROW(Ogden{material}, std::invalid_argument);
}

}  // namespace brainshift::solve::ogden_test
