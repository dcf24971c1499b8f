// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <omp.h>

#include "solve/ensemble/each_force.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "tests/unit/solve/ensemble/members.hpp"
#include "tests/unit/solve/material_cases.hpp"

namespace brainshift::solve::each_bound_test {

constexpr double side = 50;
constexpr std::size_t there = 4;

void expect_bounds_and_energy_of_each(const Material& material, double nodes_per_patch, Precision precision) {
  Specimen body{test::irregular_box(6, side, 0.3),
                test::box_cells(4, side),
                {material, {.youngs_modulus = 10, .poisson_ratio = 0.1}},
                SpecimenOptions{.nodes_per_patch = nodes_per_patch, .precision = precision}};
  const std::vector<PointLaws> laws = differing_laws({material, {.youngs_modulus = 10, .poisson_ratio = 0.1}}, there);
  EachForce force(body.points, laws);
  const EachVectors parameters = differing_parameters(body, 0.8, there);
  EachVectors found(parameters.size());
  force.find(parameters, found);
  Chosen asked = {};
  asked[0] = asked[1] = asked[3] = true;
  const EachNumbers bounds = force.stiffness_bound(asked);
  const Numbers energy = force.strain_energy();
  for (std::size_t m = 0; m < there; ++m) {
    body.laws = laws[m];
    body.force(member_of(parameters, m));
    const double expected = point_state(body.points, body.laws, body.scratch).strain_energy;
    EXPECT_NEAR(energy[static_cast<Eigen::Index>(m)], expected, 1e-6 * expected) << name_of(material);
    const std::vector<double> bound = stiffness_bound(body.points, body.laws, body.scratch);
    for (std::size_t a = 0; asked[m] && a < bound.size(); ++a) {
      ASSERT_NEAR(bounds[a].of[m], bound[a], 1e-5 * bound[a]) << name_of(material) << ", member " << m;
    }
  }
  const int threads = omp_get_max_threads();
  omp_set_num_threads(threads == 1 ? 3 : 1);
  EXPECT_TRUE((force.strain_energy() == energy).all());
  const EachNumbers other = force.stiffness_bound(asked);
  for (std::size_t a = 0; a < other.size(); ++a) {
    ASSERT_EQ(other[a].of[1], bounds[a].of[1]);
  }
  omp_set_num_threads(threads);
}

TEST(EachBound, AndEnergyAreThoseOfEachMemberAlone) {
  expect_bounds_and_energy_of_each(every_law.front(), 6, Precision::double_precision);
  expect_bounds_and_energy_of_each(every_law.front(), 6, Precision::single_precision);
  expect_bounds_and_energy_of_each(every_law.front(), 0, Precision::double_precision);
  expect_bounds_and_energy_of_each(every_law.back(), 6, Precision::double_precision);
}

}  // namespace brainshift::solve::each_bound_test
