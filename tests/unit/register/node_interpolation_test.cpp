// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/node_interpolation.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration {
namespace {

using namespace builders;

Solution some_solution(Basis basis) {
  Solution result = solution([](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return {std::sin(0.2 * x.y()), 0.1 * x.z(), 3 * std::cos(0.1 * x.x())};
  });
  result.shape.basis = basis;
  return result;
}

/// Cubes of places a millimetre apart, from the middle of the ball to a little outside it, where supports are grown.
std::vector<std::vector<Eigen::Vector3d>> bricks() {
  std::vector<std::vector<Eigen::Vector3d>> result;
  for (double from_centre = 0; from_centre < radius; from_centre += 1.7) {
    std::vector<Eigen::Vector3d> brick;
    for (int n = 0; n < 27; ++n) {
      const Eigen::Vector3d way = Eigen::Vector3d(1, 2 - from_centre / 10, -0.7).normalized();
      brick.emplace_back(centre + from_centre * way + Eigen::Vector3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
    }
    result.push_back(brick);
  }
  return result;
}

struct Comparison {
  double largest = 0;  ///< difference, mm
  int answered = 0, left = 0;
};

Comparison compare(const Solution& nodes) {
  constexpr double widest = 2;
  const Points parameters = nodes.displacement;
  const NodeInterpolation together(nodes, parameters, widest);
  const solve::ShapeFunctions shape = shape_functions(nodes);
  Comparison result;
  for (const std::vector<Eigen::Vector3d>& brick : bricks()) {
    std::vector<std::optional<Eigen::Vector3d>> displacement(brick.size());
    together.at(brick, displacement);
    for (std::size_t n = 0; n < brick.size(); ++n) {
      ++(displacement[n] ? result.answered : result.left);
      if (displacement[n]) {
        const Points expected = shape.interpolate(brick[n].transpose(), parameters);
        result.largest = std::max(result.largest, (*displacement[n] - expected.row(0).transpose()).norm());
      }
    }
  }
  return result;
}

TEST(NodeInterpolation, IsThatOfTheShapeFunctions) {
  for (const Basis basis : {Basis::linear, Basis::quadratic, Basis::modified_quadratic}) {
    const Comparison found = compare(some_solution(basis));
    EXPECT_LT(found.largest, 1e-9) << static_cast<int>(basis);
    EXPECT_GT(found.answered, 20 * found.left) << static_cast<int>(basis);
  }
}

TEST(NodeInterpolation, IsThatOfTheShapeFunctionsWithAHighPenaltyAndSpacingsThatDiffer) {
  Solution nodes = some_solution(Basis::modified_quadratic);
  nodes.shape.penalty = 1e-5;
  for (std::size_t n = 0; n < nodes.spacing.size(); ++n) {
    nodes.spacing[n] *= n % 3 == 0 ? 1.3 : 1;
  }
  const Comparison found = compare(nodes);
  EXPECT_LT(found.largest, 1e-9);
  EXPECT_GT(found.answered, found.left);
}

TEST(NodeInterpolation, LeavesWhatACutMayHide) {
  Solution nodes = some_solution(Basis::modified_quadratic);
  nodes.cut.vertices.resize(3, 3);
  nodes.cut.vertices << 3, -5, -30, 3, -50, 40, 3, 40, 40;
  nodes.cut.facets.resize(1, 3);
  nodes.cut.facets << 0, 1, 2;
  nodes.cut.front = {{0, 1}, {1, 2}, {2, 0}};
  const Comparison found = compare(nodes);
  EXPECT_LT(found.largest, 1e-9);
  EXPECT_GT(found.left, 0);
}

TEST(NodeInterpolation, LeavesPlacesThatLieFarApart) {
  const Solution nodes = some_solution(Basis::linear);
  const NodeInterpolation together(nodes, nodes.displacement, 2);
  const std::vector<Eigen::Vector3d> places = {centre, centre + Eigen::Vector3d(10, 0, 0)};
  std::vector<std::optional<Eigen::Vector3d>> displacement(2);
  together.at(places, displacement);
  EXPECT_FALSE(displacement[0] || displacement[1]);
}

}  // namespace
}  // namespace brainshift::registration
