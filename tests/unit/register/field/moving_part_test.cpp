// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/moving_part.hpp"

#include <gtest/gtest.h>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::moving_part_test {

using namespace builders;

TEST(MovingPart, HoldsWhatMovesAndOneVoxelAround) {
  const ImageGeometry turned = grid({28, 25, 24}, {1.6, 1.8, 2.0}, oblique());
  VectorImage whole = field(turned, [](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
  whole.at(5, 6, 7) = {1, 2, 3};
  whole.at(8, 6, 9) = {0, 0, -1};
  const VectorImage part = moving_part(whole);
  EXPECT_TRUE((part.geometry.size == Eigen::Array3i(6, 3, 5)).all());
  EXPECT_EQ(part.at(1, 1, 1), (std::array<float, 3>{1, 2, 3}));
  EXPECT_EQ(part.at(4, 1, 3), (std::array<float, 3>{0, 0, -1}));
  EXPECT_LT((part.geometry.origin - whole.geometry.to_world(Eigen::Vector3d(4, 5, 6))).norm(), 1e-12);
}

TEST(MovingPart, EndsWithTheImage) {
  VectorImage whole = field(grid(), [](const Eigen::Vector3d&) { return Eigen::Vector3d::Ones(); });
  EXPECT_EQ(moving_part(whole).voxels, whole.voxels);
}

TEST(MovingPart, OfAFieldThatIsZeroHasTwoVoxelsAlongEachAxis) {
  const VectorImage part = moving_part(field(grid(), [](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); }));
  EXPECT_TRUE((part.geometry.size == Eigen::Array3i(2, 2, 2)).all());
}

}  // namespace brainshift::registration::moving_part_test
