// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_motion.hpp"

#include <gtest/gtest.h>

#include "solve/dynamics/motion.hpp"
#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/ensemble/each_displacement.hpp"
#include "solve/run/prepare.hpp"
#include "solve/shape/nodal_displacement.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::each_motion_test {

TEST(EachMotion, StepsAsOneMotionDoes) {
  Model model = uniaxial(0.9, 5);
  model.gravity = {1, 0, 0};
  SolveOptions options;
  options.shape.basis = Basis::linear;
  SolveMeasures measures;
  const Body body = prepare(model, options, {}, measures, {}).body;
  Motion alone(body, 0);
  const std::vector<Member> loads(2, {.laws = body.laws, .external = body.external});
  EachMotion each(body, loads);
  std::vector<double> mass(body.nodes());
  EachNumbers mass_of_each(body.nodes());
  for (std::size_t a = 0; a < mass.size(); ++a) {
    mass[a] = 3e6 * (1 + 0.1 * static_cast<double>(a % 3));
    std::fill_n(mass_of_each[a].of, members, mass[a]);
  }
  Chosen all;
  all.fill(true);
  NumberOfEach<double> beta;
  std::fill_n(beta.of, members, 0.8);
  alone.weigh(mass, relaxation_alpha);
  each.weigh(mass_of_each, all);
  for (const double fraction : {0.1, 0.3, 0.5, 0.5}) {
    std::swap(each.force, each.force_before);
    alone.step(body.laws, mass, relaxation_alpha, 0.8, fraction, fraction);
    each.step(mass_of_each, beta, fraction, fraction, all);
  }
  EXPECT_LT(largest_difference(member_of(each.now, 1), alone.now), 1e-12);
  EXPECT_LT(largest_difference(member_of(each.next, 1), alone.next), 1e-12);
  EXPECT_LT(largest_difference(member_of(each.force, 1), alone.force), 1e-9 * largest_component(alone.force));
  EXPECT_NEAR(longest_difference_of_each(each.now, each.before)[1], longest_difference(alone.now, alone.before), 1e-12);
  const EachVectors seen = displacement_of_each(body.nodal_rows, each.now);
  EXPECT_LT(longest_difference(member_of(seen, 1), displacement_of(body.nodal_rows, alone.now)), 1e-12);
  EXPECT_NEAR(each.farthest()[1], largest_component(alone.now), 1e-12);
  EXPECT_EQ(each.farthest()[2], 0);  // that member is not there
  each.let_go(1);
  EXPECT_EQ(each.farthest()[1], 0);
  EXPECT_GT(each.farthest()[0], 1);
}

}  // namespace brainshift::solve::each_motion_test
