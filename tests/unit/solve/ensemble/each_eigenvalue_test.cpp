// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_eigenvalue.hpp"

#include <gtest/gtest.h>

#include "solve/force/largest_eigenvalue.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "tests/unit/solve/ensemble/members.hpp"

namespace brainshift::solve::each_eigenvalue_test {

TEST(BoundTightnessOfEach, IsThatOfEachMemberAlone) {
  constexpr std::size_t there = 3;
  Specimen body{test::irregular_box(6, 50, 0.3), test::box_cells(4, 50), {Material{}}, SpecimenOptions{}};
  const std::vector<PointLaws> laws = differing_laws({Material{}}, there);
  EachForce force(body.points, laws);
  EachVectors rest(body.cloud.size(), VectorOfEach<double>{}), resistance(rest);
  force.find(rest, resistance);
  Chosen all;
  all.fill(true);
  const Numbers found = bound_tightness_of_each(force, force.stiffness_bound(all));
  for (std::size_t m = 0; m < there; ++m) {
    body.laws = laws[m];
    body.force(body.rest());
    const std::vector<double> bound = stiffness_bound(body.points, body.laws, body.scratch);
    const double expected = bound_tightness(body.points, body.laws, bound, bound);
    EXPECT_LT(expected, 1);
    EXPECT_NEAR(found[static_cast<Eigen::Index>(m)], expected, 1e-9);
  }
}

}  // namespace brainshift::solve::each_eigenvalue_test
