// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/measures.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::measures_test {

using namespace builders;

const ImageGeometry g = grid({12, 10, 9}, {2, 2.5, 3}, oblique());

Eigen::Vector3d at_rest(const Eigen::Vector3d&) {
  return Eigen::Vector3d::Zero();
}

/// Fields of a small image, all of it brain but its first voxel.
struct Fields {
  VectorImage forward = field(g, at_rest), resampling = forward;
  ScalarImage jacobian = image(g, [](const Eigen::Vector3d&) { return 1.0; });
  std::vector<Zone> zone = std::vector<Zone>(g.voxel_count(), Zone::brain);
  Solution nodes;

  Fields() {
    zone[0] = Zone::beyond;
    nodes.positions = Points(1, 3);
    nodes.positions.row(0) = centre;
    nodes.displacement = Points::Zero(1, 3);
    nodes.spacing = {30};
  }
  RegisterMeasures measures() const { return measure_fields(forward, resampling, jacobian, zone, nodes); }
};

TEST(Measures, OfABodyAtRestAreNone) {
  const RegisterMeasures m = Fields().measures();
  EXPECT_EQ(m.brain_voxels, g.voxel_count() - 1);
  EXPECT_EQ(m.moved_voxels, 0U);
  EXPECT_EQ(m.inverse_max, 0);
  EXPECT_EQ(m.largest_displacement, 0);
  EXPECT_EQ(m.fit_error, 0);
  EXPECT_EQ(m.jacobian_min, 1);
  EXPECT_EQ(m.folded_voxels, 0U);
  EXPECT_EQ(m.without_nodes, 0U);
}

/// As where tissue was taken out and nobody says so.
TEST(Measures, VoxelsFarFromEveryNodeAreCounted) {
  Fields fields;
  fields.nodes.spacing = {6};
  std::size_t far = 0;
  for_each_voxel(g, [&](const Eigen::Vector3d& x, std::size_t) { far += (x - centre).norm() > 9 ? 1 : 0; });
  EXPECT_NEAR(static_cast<double>(fields.measures().without_nodes) / static_cast<double>(far), 1, 0.25);
}

TEST(Measures, InverseErrorIsWhatTheWayThereAndBackLeaves) {
  Fields fields;
  fields.forward = field(g, [](const Eigen::Vector3d&) { return Eigen::Vector3d(2, -1, 0.5); });
  fields.resampling = field(g, [](const Eigen::Vector3d&) { return Eigen::Vector3d(-2, 1, -0.5); });
  EXPECT_NEAR(fields.measures().inverse_max, 0, 1e-6) << "a shift and the shift back";
  fields.resampling = field(g, [](const Eigen::Vector3d&) { return Eigen::Vector3d(-2, 1 + 0.3, -0.5 - 0.4); });
  const RegisterMeasures m = fields.measures();
  EXPECT_NEAR(m.inverse_mean, 0.5, 1e-6);
  EXPECT_NEAR(m.inverse_999, 0.5, 1e-6);
  EXPECT_NEAR(m.inverse_max, 0.5, 1e-6);
  EXPECT_EQ(m.moved_voxels, g.voxel_count());
  EXPECT_NEAR(m.largest_displacement, std::sqrt(5.25), 1e-6);
}

TEST(Measures, Inverse999IsExceededByOneVoxelInAThousand) {
  Fields fields;
  for (const auto& [voxel, error] : {std::pair(10, 9.0F), {20, 8.0F}, {30, 3.0F}, {40, 1.0F}}) {
    fields.resampling.voxels[static_cast<std::size_t>(voxel)] = {error, 0, 0};
  }
  const RegisterMeasures m = fields.measures();
  ASSERT_EQ(m.brain_voxels, 1079U);
  EXPECT_NEAR(m.inverse_999, 3, 1e-6) << "two of 1079 are larger";
}

/// u = s x about the centre has the inverse −s/(1 + s) y; it is looked up where the point has gone.
TEST(Measures, InverseIsLookedUpAtThePlaceReached) {
  static constexpr double s = -0.2;  // inwards: no place beyond the image
  Fields fields;
  fields.forward = field(g, [](const Eigen::Vector3d& x) -> Eigen::Vector3d { return s * (x - centre); });
  fields.resampling = field(g, [](const Eigen::Vector3d& y) -> Eigen::Vector3d { return -s / (1 + s) * (y - centre); });
  EXPECT_LE(fields.measures().inverse_max, 1e-5);
}

TEST(Measures, InverseErrorOutsideTheBrainDoesNotCount) {
  Fields fields;
  fields.resampling.voxels[0] = {9, 9, 9};
  EXPECT_EQ(fields.measures().inverse_max, 0);
  fields.resampling.voxels[5] = {3, 0, 0};
  const RegisterMeasures m = fields.measures();
  EXPECT_NEAR(m.inverse_max, 3, 1e-6);
  EXPECT_NEAR(m.inverse_mean, 3.0 / static_cast<double>(m.brain_voxels), 1e-6);
}

TEST(Measures, JacobianIsThatOfTheBrainAndFoldsCountEverywhere) {
  Fields fields;
  fields.jacobian.voxels[0] = -0.5F;
  fields.jacobian.voxels[7] = 0.25F;
  fields.jacobian.voxels[8] = 1.5F;
  const RegisterMeasures m = fields.measures();
  EXPECT_EQ(m.jacobian_min, 0.25);
  EXPECT_EQ(m.jacobian_max, 1.5);
  EXPECT_EQ(m.field_jacobian_min, -0.5);
  EXPECT_EQ(m.folded_voxels, 1U);
  fields.jacobian.voxels[7] = 0;
  EXPECT_EQ(fields.measures().folded_voxels, 2U) << "a volume of 0 is folded";
}

TEST(Measures, FitErrorIsThatOfTheNodesInTheImage) {
  Fields fields;
  const Eigen::Vector3d u(1, 2, -2);
  fields.forward = field(g, [&](const Eigen::Vector3d&) { return u; });
  fields.nodes.positions = Points(3, 3);
  fields.nodes.positions << centre.transpose(), (centre + Eigen::Vector3d(3, 1, 2)).transpose(),
      (centre + Eigen::Vector3d(500, 0, 0)).transpose();
  fields.nodes.spacing.assign(3, 30);
  fields.nodes.displacement = Points(3, 3);
  fields.nodes.displacement << u.transpose(), (u + Eigen::Vector3d(0, 0.6, 0.8)).transpose(), 99, 99, 99;
  EXPECT_NEAR(fields.measures().fit_error, 1, 1e-6) << "the third node lies outside";
}

}  // namespace brainshift::registration::measures_test
