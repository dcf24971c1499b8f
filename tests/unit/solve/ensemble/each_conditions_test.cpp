// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_conditions.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/unit/solve/noisy_nodes.hpp"
#include "tests/unit/solve/weighted_box.hpp"

namespace brainshift::solve::each_conditions_test {

/// The upper face is moved down, the lower one sideways and up alone: components differ in their nodes.
struct Held {
  WeightedBox cloud;
  Points prescribed = Points::Constant(static_cast<Eigen::Index>(cloud.nodes.size()), 3, std::nan(""));
  std::vector<std::int32_t> names;
  PatchRim rim;  // none

  Held() {
    for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
      const double z = cloud.nodes.positions(a, 2);
      if (z > 40 - 1e-9) {
        prescribed.row(a) << 0, 0.1, -2;
      } else if (z < 1e-9) {
        prescribed(a, 0) = 0.5;
        prescribed(a, 2) = 0.2;
      }
      names.push_back(static_cast<std::int32_t>(a));
    }
  }
  /// The same with a noise that differs from axis to axis.
  EssentialConditions noisy() const {
    return {prescribed, cloud.rows, names, noisy_nodes(prescribed.rows(), 1e-7), ShapeRows()};
  }
};

/// Two applications, so that springs have a step before; each member its own masses and values.
void expect_each_alone(const EssentialConditions& conditions, const Held& held, bool own_values) {
  std::vector<Points> values;
  EachNumbers mass(held.cloud.nodes.size());
  EachVectors start(mass.size()), vectors;
  for (std::size_t m = 0; m < members; ++m) {
    const double factor = 1 + 0.1 * static_cast<double>(m);
    values.emplace_back(factor * held.prescribed);
    for (std::size_t a = 0; a < mass.size(); ++a) {
      mass[a].of[m] = factor * held.cloud.mass[a] * (1 + 0.01 * static_cast<double>((m * a) % 7));
    }
    set_member(held.cloud.random_parameters(0.1 * factor), m, start);
  }
  EachConditions each(conditions, own_values ? values : std::vector<Points>());
  Chosen all;
  all.fill(true);
  constexpr double alpha = 3;
  each.factorise(mass, alpha, all);
  vectors = start;
  each.apply(1, vectors);
  const EachVectors between = vectors;
  each.apply(1, vectors);
  for (std::size_t m = 0; m < members; ++m) {
    EssentialConditions alone = conditions;
    if (own_values) {
      alone = EssentialConditions(values[m], held.cloud.rows, held.names, Imposition::exact, held.rim);
    }
    std::vector<double> of_member(mass.size());
    std::transform(mass.begin(), mass.end(), of_member.begin(), [m](const auto& each_mass) { return each_mass.of[m]; });
    alone.factorise(of_member, alpha);
    NodalVectors expected = member_of(start, m);
    alone.apply(1, expected);
    const NodalVectors expected_between = expected;
    alone.apply(1, expected);
    const auto i = static_cast<Eigen::Index>(m);
    EXPECT_LT(largest_difference(member_of(vectors, m), expected), 1e-11) << "member " << m;
    EXPECT_NEAR(each.multiplier_work()[i], alone.multiplier_work(), 1e-9 * std::abs(alone.multiplier_work()) + 1e-9);
    EXPECT_NEAR(each.spring_work(between, vectors)[i], alone.spring_work(expected_between, expected),
                1e-9 * std::abs(alone.spring_work(expected_between, expected)) + 1e-12);
  }
}

TEST(EachConditions, HoldEachMemberInsideARimByItsOwnLoad) {
  Held held;
  std::vector<std::int32_t> above;
  std::int32_t inner = -1;
  for (const std::int32_t a : held.names) {
    if (held.prescribed.row(a).allFinite()) {
      above.push_back(a);
      held.prescribed(a, 1) += 0.1 * a;
    } else if (held.prescribed.row(a).array().isNaN().all()) {
      inner = a;
    }
  }
  constexpr std::array shares{1.5, -0.5};
  held.rim.node = {above[3]};
  held.rim.rows.append(held.cloud.rows[static_cast<std::size_t>(inner)]);
  held.rim.extension.append({std::span(above).subspan(3, 2), shares, {}});
  const EssentialConditions conditions(held.prescribed, held.cloud.rows, held.names, Imposition::exact, held.rim);
  EXPECT_NEAR(conditions.components()[1].prescribed[3],
              1.5 * held.prescribed(above[3], 1) - 0.5 * held.prescribed(above[4], 1), 1e-12);
  expect_each_alone(conditions, held, true);
}

TEST(EachConditions, HoldEachMemberAsItWouldBeHeldAlone) {
  const Held held;
  const EssentialConditions exact(held.prescribed, held.cloud.rows, held.names);
  expect_each_alone(exact, held, false);
  expect_each_alone(exact, held, true);
}

TEST(EachConditions, HoldEachMemberWhereNoConditionSeesAnother) {
  Held held;
  held.prescribed.bottomRows(held.prescribed.rows() - 1).setConstant(std::nan(""));
  ASSERT_TRUE(held.prescribed.row(0).array().isFinite().any());
  expect_each_alone(EssentialConditions(held.prescribed, held.cloud.rows, held.names), held, false);
}

TEST(EachConditions, GiveWayToEachMemberAsToItAlone) {
  const Held held;
  const EssentialConditions noisy = held.noisy();
  expect_each_alone(noisy, held, false);
  NodalVectors rest(4 * held.cloud.nodes.size(), 0.0);
  EssentialConditions soft = noisy;
  soft.factorise(held.cloud.mass, 3);
  soft.apply(1, rest);
  EXPECT_GT(soft.largest_error(1, rest), 0.1);  // they do
}

TEST(EachConditions, PrescribeNothingToAMemberThatIsLetGo) {
  const Held held;
  EachConditions each(EssentialConditions(held.prescribed, held.cloud.rows, held.names), {});
  EachNumbers mass(held.cloud.nodes.size());
  for (NumberOfEach<double>& of_node : mass) {
    std::fill_n(of_node.of, members, 1.0);
  }
  Chosen all;
  all.fill(true);
  each.factorise(mass, 3, all);
  each.let_go(2);
  EachVectors vectors(mass.size(), VectorOfEach<double>{});
  each.apply(1, vectors);
  EXPECT_EQ(largest_component(member_of(vectors, 2)), 0);
  EXPECT_GT(largest_component(member_of(vectors, 1)), 1);
}

}  // namespace brainshift::solve::each_conditions_test
