// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/span_cavity.hpp"

#include <gtest/gtest.h>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::span_cavity_test {

using namespace builders;

TEST(SpanCavity, GoesOnWithAHarmonicDisplacement) {
  // Of second order, as the seven-point stencil is exact for it.
  const auto harmonic = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    const Eigen::Vector3d y = x - centre;
    return {0.1 * y.x() + 0.02 * y.y() * y.z(), 1 - 0.2 * y.z(), 0.01 * (y.x() * y.x() - y.y() * y.y())};
  };
  const ImageGeometry g = grid();
  VectorImage spanned = field(g, harmonic);
  const VectorImage exact = spanned;
  std::vector<std::size_t> hollow;
  for_each_voxel(g, [&](const Eigen::Vector3d& x, std::size_t v) {
    if ((x - centre).norm() < 12) {
      hollow.push_back(v);
      spanned.voxels[v] = {1000, 1000, 1000};
    }
  });
  span_cavity(
      hollow, [](std::size_t) { return true; }, spanned);
  double largest = 0;
  for (std::size_t v = 0; v < g.voxel_count(); ++v) {
    largest = std::max(largest, (at(spanned, v) - at(exact, v)).norm());
  }
  EXPECT_LT(largest, 2e-3);
}

TEST(SpanCavity, PrescribesNothingWhereNothingMoves) {
  const ImageGeometry g = grid();
  const auto shift = [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 2, -3); };
  VectorImage spanned = field(g, shift);
  std::vector<std::size_t> hollow;
  const auto lies_open = [&](const Eigen::Vector3d& x) { return x.z() > centre.z() + 10; };
  std::vector<std::uint8_t> open(g.voxel_count(), 0);
  for_each_voxel(g, [&](const Eigen::Vector3d& x, std::size_t v) {
    open[v] = lies_open(x) ? 1 : 0;
    if (open[v] != 0) {
      spanned.voxels[v] = {0, 0, 0};
    } else if (x.z() > centre.z()) {
      hollow.push_back(v);
    }
  });
  span_cavity(
      hollow, [&](std::size_t v) { return open[v] == 0; }, spanned);
  for (const std::size_t v : hollow) {
    EXPECT_LT((at(spanned, v) - Eigen::Vector3d(0, 2, -3)).norm(), 2e-3);
  }
}

}  // namespace brainshift::registration::span_cavity_test
