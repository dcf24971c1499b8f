// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "solve/output/solution_file.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::field_of_places_test {

using namespace builders;

Solution some_solution(Basis basis) {
  Solution result = solution([](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return {std::sin(0.2 * x.y()), 0.1 * x.z(), 3 * std::cos(0.1 * x.x())};
  });
  result.shape.basis = basis;
  return result;
}

/// Cubes of places a millimetre apart, from the middle of the ball to a little outside it, where supports are grown.
std::vector<std::vector<Eigen::Vector3d>> cubes() {
  std::vector<std::vector<Eigen::Vector3d>> result;
  for (double from_centre = 0; from_centre < radius; from_centre += 1.7) {
    std::vector<Eigen::Vector3d> cube;
    for (int n = 0; n < 27; ++n) {
      const Eigen::Vector3d way = Eigen::Vector3d(1, 2 - from_centre / 10, -0.7).normalized();
      cube.emplace_back(centre + from_centre * way + Eigen::Vector3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
    }
    result.push_back(cube);
  }
  return result;
}

/// Largest difference at a place between the field found together with those of its cube and alone, mm.
double together_and_alone(const Solution& nodes) {
  const solve::ShapeFunctions shape = shape_functions(nodes);
  double largest = 0;
  for (const std::vector<Eigen::Vector3d>& cube : cubes()) {
    Points places(static_cast<Eigen::Index>(cube.size()), 3);
    for (Eigen::Index n = 0; n < places.rows(); ++n) {
      places.row(n) = cube[static_cast<std::size_t>(n)];
    }
    const Points together = shape.interpolate(places, nodes.displacement);
    for (Eigen::Index n = 0; n < places.rows(); ++n) {
      const Points alone = shape.interpolate(places.row(n), nodes.displacement);
      largest = std::max(largest, (together.row(n) - alone).norm());
    }
  }
  return largest;
}

TEST(FieldOfPlaces, IsThatOfEachPlaceAlone) {
  for (const Basis basis : {Basis::linear, Basis::quadratic, Basis::modified_quadratic}) {
    EXPECT_EQ(together_and_alone(some_solution(basis)), 0) << static_cast<int>(basis);
  }
}

TEST(FieldOfPlaces, IsThatOfEachPlaceAloneWithAHighPenaltyAndSpacingsThatDiffer) {
  Solution nodes = some_solution(Basis::modified_quadratic);
  nodes.shape.penalty = 1e-5;
  for (std::size_t n = 0; n < nodes.spacing.size(); ++n) {
    nodes.spacing[n] *= n % 3 == 0 ? 1.3 : 1;
  }
  EXPECT_EQ(together_and_alone(nodes), 0);
}

TEST(FieldOfPlaces, IsThatOfEachPlaceAloneBesideACut) {
  Solution nodes = some_solution(Basis::modified_quadratic);
  nodes.cut.vertices.resize(3, 3);
  nodes.cut.vertices << 3, -5, -30, 3, -50, 40, 3, 40, 40;
  nodes.cut.facets.resize(1, 3);
  nodes.cut.facets << 0, 1, 2;
  nodes.cut.front = {{0, 1}, {1, 2}, {2, 0}};
  EXPECT_EQ(together_and_alone(nodes), 0);
}

}  // namespace brainshift::registration::field_of_places_test
