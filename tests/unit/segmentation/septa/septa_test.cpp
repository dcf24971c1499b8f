// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/septa/septa.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::segmentation::septa_test {

constexpr double floor_of_cerebrum = -10;  // mm, behind y = 0
constexpr double grid_step = 2;            // mm, on which septa are drawn

/// A brain of 80 x 100 x 80 mm about the origin: two hemispheres of cortex with fluid between, a core of white matter
/// that goes through the middle, and behind and below the cerebellum.
std::uint16_t number_at(const Eigen::Vector3d& x) {
  if (std::abs(x.x()) > 40 || std::abs(x.y()) > 50 || std::abs(x.z()) > 40) {
    return 0;
  }
  const bool left = x.x() > 0;  // LPS
  if (x.z() < floor_of_cerebrum && x.y() > 0) {
    return left ? 8 : 47;
  }
  if (std::abs(x.y()) < 20 && std::abs(x.z()) < 8 && std::abs(x.x()) < 25) {
    return left ? 2 : 41;
  }
  return std::abs(x.x()) < 1.6 ? 24 : left ? 3 : 42;
}

LabelMap drawn(const std::function<std::uint16_t(const Eigen::Vector3d&)>& number) {
  LabelMap map;
  map.geometry.size = {80, 94, 80};
  map.geometry.spacing = {1.5, 1.4, 1.5};
  map.geometry.direction << -1, 0, 0, 0, 1, 0, 0, 0, 1;  // left-handed
  map.geometry.origin = {60, -66, -60};
  map.voxels.resize(map.geometry.voxel_count());
  for (int k = 0; k < map.geometry.size.z(); ++k) {
    for (int j = 0; j < map.geometry.size.y(); ++j) {
      for (int i = 0; i < map.geometry.size.x(); ++i) {
        map.at(i, j, k) = number(map.geometry.to_world({double(i), double(j), double(k)}));
      }
    }
  }
  return map;
}

/// How far the farthest vertex that `on` selects is from where `distance` is 0.
double farthest(const Surface& sheet, const std::function<bool(const Eigen::Vector3d&)>& on,
                const std::function<double(const Eigen::Vector3d&)>& distance) {
  double most = 0;
  for (const auto& row : sheet.vertices.rowwise()) {
    const Eigen::Vector3d x = row.transpose();
    most = on(x) ? std::max(most, std::abs(distance(x))) : most;
  }
  return most;
}

TEST(Septa, LieHalfwayBetweenTheHemispheresAndAboveTheCerebellum) {
  const Surface sheet = septa_of(drawn(number_at));
  EXPECT_LT(farthest(
                sheet, [](const auto& x) { return x.z() > 5; }, [](const auto& x) { return x.x(); }),
            grid_step);
  EXPECT_LT(farthest(
                sheet, [](const auto& x) { return std::abs(x.x()) > 8 && x.y() > 8 && x.y() < 45 && x.z() > -20; },
                [](const auto& x) { return x.z() - floor_of_cerebrum; }),
            grid_step);
}

TEST(Septa, ReachBeyondTheBrainAndEndWhereWhiteMatterJoinsIt) {
  const Surface sheet = septa_of(drawn(number_at));
  EXPECT_GT(sheet.vertices.col(2).maxCoeff(), 40 + 2);
  EXPECT_LT(sheet.vertices.col(1).minCoeff(), -50 - 2);
  const auto in_commissure = [](const Eigen::Vector3d& x) { return std::abs(x.y()) < 16 && std::abs(x.z()) < 4; };
  EXPECT_EQ(farthest(sheet, in_commissure, [](const auto&) { return 1; }), 0) << "a vertex lies in the commissure";
}

TEST(Septa, EndWhereTheCorpusCallosumHasANumber) {
  const Surface sheet = septa_of(drawn([](const Eigen::Vector3d& x) {
    const std::uint16_t number = number_at(x);
    return (number == 2 || number == 41) && std::abs(x.x()) < 5 ? std::uint16_t{253} : number;
  }));
  EXPECT_NEAR(area(sheet), area(septa_of(drawn(number_at))), 0.1 * area(sheet));
}

TEST(Septa, HangTogetherWhereThreePartsMeet) {
  const Surface sheet = septa_of(drawn(number_at));
  std::map<std::pair<std::int32_t, std::int32_t>, int> triangles_at;
  for (const auto& t : sheet.triangles.rowwise()) {
    for (int i = 0; i < 3; ++i) {
      ++triangles_at[std::minmax(t[i], t[(i + 1) % 3])];
    }
  }
  int branching = 0;
  for (const auto& [edge, count] : triangles_at) {
    EXPECT_LE(count, 4);
    branching += count == 3 ? 1 : 0;
  }
  EXPECT_GT(branching, 15) << "edges of 2 mm along the 50 mm where falx and tentorium meet";
}

TEST(Septa, AreRefusedWhereTheLabelsDoNotTellLeftFromRight) {
  const auto only = [](bool left) {
    return drawn([left](const Eigen::Vector3d& x) { return (x.x() > 0) == left ? number_at(x) : std::uint16_t{0}; });
  };
  EXPECT_NE(test::refusal([&] { septa_of(only(true)); }).find("the left hemisphere only"), std::string::npos);
  EXPECT_NE(test::refusal([&] { septa_of(only(false)); }).find("the right hemisphere only"), std::string::npos);
  const LabelMap classes = drawn([](const Eigen::Vector3d& x) { return std::uint16_t(number_at(x) != 0 ? 1 : 0); });
  EXPECT_NE(test::refusal([&] { septa_of(classes); }).find("neither hemisphere"), std::string::npos);
  const LabelMap apart = drawn([](const Eigen::Vector3d& x) {
    return std::abs(x.x()) < 15 || number_at(x) > 42 || number_at(x) == 8 ? std::uint16_t{0} : number_at(x);
  });
  EXPECT_NE(test::refusal([&] { septa_of(apart); }).find("nowhere face each other"), std::string::npos);
}

}  // namespace brainshift::segmentation::septa_test
