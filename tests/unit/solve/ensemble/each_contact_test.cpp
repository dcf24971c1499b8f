// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_contact.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/weighted_box.hpp"

namespace brainshift::solve::each_contact_test {

TEST(EachContact, PushesEachMemberAsItWouldBePushedAlone) {
  const WeightedBox cloud;
  std::vector<std::int32_t> nodes(cloud.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  const SignedDistance skull(test::box(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(41)));
  Contact contact(skull, cloud.nodes.positions, nodes, cloud.rows);
  EachContact each(contact);
  Chosen chosen;
  chosen.fill(true);
  chosen[3] = false;
  EachNumbers mass(cloud.mass.size());
  EachVectors vectors(cloud.mass.size(), VectorOfEach<double>{});
  for (std::size_t m = 0; m < members; ++m) {
    for (std::size_t a = 0; a < mass.size(); ++a) {
      mass[a].of[m] = cloud.mass[a] * (1 + 0.1 * static_cast<double>(m));
    }
    set_member(cloud.random_parameters(0.3 * static_cast<double>(m)), m, vectors);
  }
  const EachVectors before = vectors;
  each.weigh(mass, chosen);
  each.apply(chosen, vectors);
  std::size_t pushed = 0;
  for (std::size_t m = 0; m < members; ++m) {
    NodalVectors expected = member_of(before, m);
    if (chosen[m]) {
      std::vector<double> of_member(mass.size());
      std::transform(mass.begin(), mass.end(), of_member.begin(),
                     [m](const auto& each_mass) { return each_mass.of[m]; });
      contact.weigh(of_member);
      contact.apply(expected);
    }
    const NodalVectors found = member_of(vectors, m);
    pushed += found == member_of(before, m) ? 0 : 1;
    EXPECT_LT(largest_difference(found, expected), 1e-13) << "member " << m;
  }
  EXPECT_GT(pushed, members / 2);
  EXPECT_LT(pushed, members);
}

}  // namespace brainshift::solve::each_contact_test
