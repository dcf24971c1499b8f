// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/contact.hpp"

#include <gtest/gtest.h>

#include "solve/boundary/essential_conditions.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/weighted_box.hpp"

namespace brainshift::solve::contact_test {

using test::box;
using test::irregular_box;
using test::random_points;

constexpr double side = 40;

class ContactWithABox : public testing::Test {
 protected:
  WeightedBox cloud;
  SignedDistance skull{box(Eigen::Vector3d::Constant(-2), Eigen::Vector3d::Constant(side + 2))};
  std::vector<std::int32_t> surface_nodes() const {
    std::vector<std::int32_t> nodes;
    for (std::size_t a = 0; a < cloud.nodes.size(); ++a) {
      if (cloud.nodes.on_surface[a] != 0) {
        nodes.push_back(static_cast<std::int32_t>(a));
      }
    }
    return nodes;
  }
};

TEST_F(ContactWithABox, LeavesABodyAloneThatDoesNotTouch) {
  Contact contact(skull, cloud.nodes.positions, surface_nodes(), cloud.rows);
  contact.weigh(cloud.mass);
  const NodalVectors inside = cloud.shifted({0.5, -0.5, 0.5});
  NodalVectors u = inside;
  contact.apply(u);
  EXPECT_EQ(u, inside);
  EXPECT_EQ(contact.measure(u).touching, 0u);
}

TEST_F(ContactWithABox, PutsPenetratingNodesBackAlongTheNormal) {
  Contact contact(skull, cloud.nodes.positions, surface_nodes(), cloud.rows);
  contact.weigh(cloud.mass);
  NodalVectors u = cloud.shifted({3.0, 0, 0});  // one millimetre through the wall at x = side + 2
  EXPECT_NEAR(contact.measure(u).largest_penetration, 1.0, 1e-3);
  for (int step = 0; step < 200; ++step) {
    contact.apply(u);
  }
  EXPECT_LE(contact.measure(u).largest_penetration, 0.01);
  EXPECT_GE(contact.measure(u).touching,
            20u);  // of 49; the others were drawn a little further in with their neighbours
  const Points moved = cloud.displacement(u);
  EXPECT_LE(moved.rightCols<2>().cwiseAbs().maxCoeff(), 0.2);  // frictionless: only the normals at the rim are oblique
}

TEST_F(ContactWithABox, CountsTheWorkOfItsPushes) {
  Contact contact(skull, cloud.nodes.positions, surface_nodes(), cloud.rows);
  contact.weigh(cloud.mass);
  const NodalVectors before = cloud.shifted({2.9, 0.2, 0}), free = cloud.shifted({3.0, 0, 0});
  NodalVectors after = free;
  contact.apply(after);
  const double work = cloud.push_work(before, free, after);
  EXPECT_NE(work, 0);
  EXPECT_NEAR(contact.push_work(before, after), work, 1e-9 * std::abs(work));
}

TEST_F(ContactWithABox, SaysWhenANodeIsTooFarOutToBePushedBack) {
  SignedDistanceOptions near;
  near.far = false;
  const Surface surface = box(Eigen::Vector3d::Constant(-2), Eigen::Vector3d::Constant(side + 2));
  Contact contact(SignedDistance(surface, near), cloud.nodes.positions, surface_nodes(), cloud.rows);
  EXPECT_FALSE(contact.measure(cloud.shifted({2 + 0.9 * near.band(), 0, 0})).lost);
  EXPECT_TRUE(contact.measure(cloud.shifted({2 + 1.5 * near.band(), 0, 0})).lost);
  EXPECT_FALSE(Contact(skull, cloud.nodes.positions, surface_nodes(), cloud.rows)
                   .measure(cloud.shifted({2 + 1.5 * near.band(), 0, 0}))
                   .lost);  // all distances are known
}

TEST_F(ContactWithABox, AllowsNodesToStayWhereTheyStarted) {
  const SignedDistance tight(box(Eigen::Vector3d::Constant(0.3), Eigen::Vector3d::Constant(side - 0.3)));
  Contact contact(tight, cloud.nodes.positions, surface_nodes(), cloud.rows);
  contact.weigh(cloud.mass);
  NodalVectors u = cloud.shifted(Eigen::Vector3d::Zero());
  contact.apply(u);
  EXPECT_EQ(u, cloud.shifted(Eigen::Vector3d::Zero()));
}

}  // namespace brainshift::solve::contact_test
