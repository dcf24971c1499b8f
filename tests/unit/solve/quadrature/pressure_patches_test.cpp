// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/quadrature/pressure_patches.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::pressure_patches_test {

using test::random_points;

constexpr int count = 600;
using Modes = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// Points of three materials with uneven shares and volumes.
struct Scene {
  Points positions = random_points(count, 50);
  std::vector<double> share, volume;
  std::vector<std::int32_t> material;

  explicit Scene(unsigned seed = 2) {
    const Points random = random_points(count, 1, seed);
    for (Eigen::Index p = 0; p < count; ++p) {
      share.push_back(0.1 + 0.4 * random(p, 0));
      volume.push_back(1 + 5 * random(p, 1));
      material.push_back(positions(p, 0) > 30 ? 2 : (random(p, 2) > 0.9 ? 1 : 0));
    }
  }
  double nodes(std::span<const std::int32_t> points) const {
    return std::accumulate(points.begin(), points.end(), 0.0,
                           [this](double sum, std::int32_t p) { return sum + share[static_cast<std::size_t>(p)]; });
  }
  Modes modes(const std::vector<std::int32_t>& points) const {
    Modes m(static_cast<Eigen::Index>(points.size()), 4);
    pressure_modes(positions, volume, points, {m.data(), static_cast<std::size_t>(m.size())});
    return m;
  }
  Eigen::VectorXd weights(const std::vector<std::int32_t>& points) const {
    Eigen::VectorXd w(static_cast<Eigen::Index>(points.size()));
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      w[i] = volume[static_cast<std::size_t>(points[static_cast<std::size_t>(i)])];
    }
    return w;
  }
};

std::vector<std::int32_t> first_points(int n) {
  std::vector<std::int32_t> points(static_cast<std::size_t>(n));
  std::iota(points.begin(), points.end(), 0);
  return points;
}

TEST(PressurePatches, HoldEveryPointOnceAndOneMaterialEach) {
  const Scene scene;
  const PressurePatches patches = pressure_patches(scene.positions, scene.share, scene.material, 4);
  std::vector<std::int32_t> sorted = patches.order;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, first_points(count));
  ASSERT_EQ(patches.begin.front(), 0);
  ASSERT_EQ(patches.begin.back(), count);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    ASSERT_LT(patches.begin[i], patches.begin[i + 1]);
    const auto of = [&](std::int32_t k) {
      return scene.material[static_cast<std::size_t>(patches.order[static_cast<std::size_t>(k)])];
    };
    for (std::int32_t k = patches.begin[i]; k < patches.begin[i + 1]; ++k) {
      EXPECT_EQ(of(k), of(patches.begin[i]));
    }
  }
}

TEST(PressurePatches, StandForAboutEquallyManyNodes) {
  const Scene scene;
  constexpr double wanted = 4;
  const PressurePatches patches = pressure_patches(scene.positions, scene.share, scene.material, wanted);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const auto first = static_cast<std::size_t>(patches.begin[i]),
               last = static_cast<std::size_t>(patches.begin[i + 1]);
    const double nodes = scene.nodes(std::span(patches.order).subspan(first, last - first));
    EXPECT_GE(nodes, 0.7 * wanted);
    EXPECT_LE(nodes, 1.5 * wanted);
  }
  const double expected = scene.nodes(patches.order) / wanted;
  EXPECT_NEAR(static_cast<double>(patches.size()), expected, 0.05 * expected);
}

TEST(PressurePatches, AreCompact) {
  const Scene scene;
  const PressurePatches patches = pressure_patches(scene.positions, scene.share, std::vector<std::int32_t>(count), 4);
  double volume = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    Eigen::AlignedBox3d box;
    for (std::int32_t k = patches.begin[i]; k < patches.begin[i + 1]; ++k) {
      box.extend(scene.positions.row(patches.order[static_cast<std::size_t>(k)]).transpose());
    }
    volume += box.volume();
    EXPECT_LE(box.sizes().maxCoeff(), 30);  // a cube of 4 of 180 nodes is 14 wide
  }
  EXPECT_LE(volume, 50.0 * 50 * 50);  // they do not overlap
}

TEST(PressurePatches, AreSinglePointsWithoutNodesPerPatch) {
  const Scene scene;
  EXPECT_EQ(pressure_patches(scene.positions, scene.share, scene.material, 0).size(), static_cast<std::size_t>(count));
}

TEST(PressurePatches, AreTheSameEachTimeAlsoWherePointsAreLevel) {
  Scene scene;
  scene.positions = scene.positions.unaryExpr([](double x) { return std::floor(x / 10); });  // many in one place
  const PressurePatches one = pressure_patches(scene.positions, scene.share, scene.material, 4);
  const PressurePatches two = pressure_patches(scene.positions, scene.share, scene.material, 4);
  EXPECT_EQ(one.order, two.order);
  EXPECT_EQ(one.begin, two.begin);
}

TEST(PressureModes, AreOrthonormalAndSpanTheLinearFunctions) {
  const Scene scene;
  for (const int n : {4, 5, 40}) {
    const auto points = first_points(n);
    const Modes m = scene.modes(points);
    const Eigen::VectorXd w = scene.weights(points);
    const Eigen::Matrix4d gram = m.transpose() * w.asDiagonal() * m;
    EXPECT_LE((gram - Eigen::Matrix4d::Identity()).norm(), 1e-12) << n;
    const Eigen::VectorXd field = (scene.positions.topRows(n) * Eigen::Vector3d(0.1, -0.3, 0.2)).array() + 7;
    EXPECT_LE((m * (m.transpose() * w.asDiagonal() * field) - field).norm(), 1e-11 * field.norm()) << n;
  }
}

/// Modes that are not zero.
int rank(const Scene& scene, const std::vector<std::int32_t>& points) {
  const Modes m = scene.modes(points);
  const Eigen::Matrix4d gram = m.transpose() * scene.weights(points).asDiagonal() * m;
  for (int k = 0; k < 4; ++k) {
    EXPECT_TRUE(m.col(k).isZero(0) || std::abs(gram(k, k) - 1) < 1e-12);
    EXPECT_LE((gram.row(k).squaredNorm() - gram(k, k) * gram(k, k)), 1e-24);
  }
  return static_cast<int>((gram.diagonal().array() > 0.5).count());
}

TEST(PressureModes, AreZeroWherePointsDoNotTellThemApart) {
  Scene scene;
  EXPECT_EQ(rank(scene, {17}), 1);
  EXPECT_EQ(rank(scene, {17, 3}), 2);
  EXPECT_EQ(rank(scene, {17, 3, 5}), 3);
  const auto points = first_points(20);
  EXPECT_EQ(rank(scene, points), 4);
  const Points solid = scene.positions;
  scene.positions.col(2).setConstant(3);  // in the plane
  EXPECT_EQ(rank(scene, points), 3);
  scene.positions.col(2) = 0.3 * solid.col(0) - 2 * solid.col(1);  // in an oblique plane
  EXPECT_EQ(rank(scene, points), 3);
  scene.positions = solid.col(0) * Eigen::RowVector3d(0.2, -1, 0.5);  // on a line
  EXPECT_EQ(rank(scene, points), 2);
  scene.positions.setConstant(40);  // in one place
  EXPECT_EQ(rank(scene, points), 1);
}

TEST(PressureModes, DoNotDependOnWhereTheBodyLies) {
  Scene scene;
  const auto points = first_points(30);
  const Modes near = scene.modes(points);
  scene.positions.rowwise() += Eigen::RowVector3d(400, -300, 1000);
  EXPECT_LE((scene.modes(points) - near).norm(), 1e-11 * near.norm());
}

}  // namespace brainshift::solve::pressure_patches_test
