// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/moving_least_squares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::moving_least_squares_test {

constexpr double side = 12;

/// Eight places amid a cloud, and the neighbours that they see.
struct EightPlaces {
  Points positions;
  Candidates candidates;
  PointLanes places{};
  std::vector<Neighbour> neighbours;
  Fit fit{};

  EightPlaces(const Points& nodes, const Points& at, double radius) : positions(nodes) {
    for (Eigen::Index a = 0; a < nodes.rows(); ++a) {
      candidates.node.push_back(static_cast<std::int32_t>(a));
      candidates.x.push_back(nodes(a, 0));
      candidates.y.push_back(nodes(a, 1));
      candidates.z.push_back(nodes(a, 2));
      candidates.radius.push_back(radius * (1 + 0.01 * static_cast<double>(a % 5)));
    }
    places.ball = {Eigen::Vector3d(at.colwise().mean()), 2 * side};
    for (int l = 0; l < lanes; ++l) {
      for (int axis = 0; axis < 3; ++axis) {
        places.at[axis][l] = at(l, axis);
      }
    }
    see();
  }
  void see(double scale = 1) {
    neighbours.resize(candidates.node.size());
    neighbours.resize(find_neighbours(candidates, scale, places, neighbours.data()));
  }
  std::vector<ShapeGradient> gradients(const FitOptions& options, Derivatives kind) const {
    std::vector<ShapeGradient> result(neighbours.size());
    differentiate(neighbours, {}, options, kind, fit, result.data());
    return result;
  }
};

EightPlaces in_space(unsigned seed = 7) {
  const Points at = (test::random_points(lanes, side / 2, seed).array() + side / 4).matrix();
  return {test::irregular_box(7, side).positions, at, 4.6};
}

EightPlaces in_plane() {
  Points at = (test::random_points(lanes, side / 2).array() + side / 4).matrix();
  at.col(2).setZero();
  return {test::irregular_rectangle(7, 7, side, side).positions, at, 5};
}

/// Some polynomial of an order of a place, and its gradient.
double polynomial(int order, const Eigen::Vector3d& x) {
  return 1 + x.dot(Eigen::Vector3d(2, -1, 0.5)) +
         (order == 2 ? 0.3 * x[0] * x[1] - 0.2 * x[1] * x[2] + 0.1 * x.squaredNorm() : 0);
}
Eigen::Vector3d slope(int order, const Eigen::Vector3d& x) {
  const Eigen::Vector3d linear(2, -1, 0.5), quadratic(0.3 * x[1], 0.3 * x[0] - 0.2 * x[2], -0.2 * x[1]);
  return order == 2 ? Eigen::Vector3d(linear + quadratic + 0.2 * x) : linear;
}

TEST(MovingLeastSquares, HaveAsManyMonomialsAsTheirOrderHas) {
  EXPECT_EQ(monomial_count(3, 1), 4);
  EXPECT_EQ(monomial_count(3, 2), 10);
  EXPECT_EQ(monomial_count(2, 1), 3);
  EXPECT_EQ(monomial_count(2, 2), 6);
}

TEST(MovingLeastSquares, SeeTheNodesWithinTheirRadii) {
  EightPlaces eight = in_space();
  eight.places.unwanted[3] = std::numeric_limits<double>::infinity();
  for (const double scale : {1.0, 1.3}) {
    eight.see(scale);
    std::array<std::vector<std::int32_t>, lanes> seen, expected;
    for (const Neighbour& s : eight.neighbours) {
      for (int l = 0; l < lanes; ++l) {
        if (s.supports(l)) {
          seen[static_cast<std::size_t>(l)].push_back(s.node);
        }
      }
    }
    for (std::size_t a = 0; a < eight.candidates.node.size(); ++a) {
      for (int l = 0; l < lanes; ++l) {
        const Eigen::RowVector3d x(eight.places.at[0][l], eight.places.at[1][l], eight.places.at[2][l]);
        const double distance = (eight.positions.row(static_cast<Eigen::Index>(a)) - x).norm();
        if (l != 3 && distance < scale * eight.candidates.radius[a]) {
          expected[static_cast<std::size_t>(l)].push_back(static_cast<std::int32_t>(a));
        }
      }
    }
    EXPECT_EQ(seen, expected);
    EXPECT_TRUE(seen[3].empty()) << "not wanted";
  }
}

/// Values and both kinds of derivatives: diffuse ones differ between fields that the basis does not hold.
TEST(MovingLeastSquares, ReproduceThePolynomialsOfTheirOrder) {
  for (const int dimensions : {2, 3}) {
    for (const int order : {1, 2}) {
      EightPlaces eight = dimensions == 3 ? in_space() : in_plane();
      const FitOptions options{dimensions, order, 0, false};
      fit_shape(eight.neighbours, options, eight.fit);
      for (const Derivatives kind : {Derivatives::full, Derivatives::diffuse}) {
        const std::vector<ShapeGradient> gradients = eight.gradients(options, kind);
        for (int l = 0; l < lanes; ++l) {
          ASSERT_NE(eight.fit.admissible[l], 0);
          const Eigen::Vector3d x(eight.places.at[0][l], eight.places.at[1][l], eight.places.at[2][l]);
          double value = 0;
          Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
          for (std::size_t a = 0; a < eight.neighbours.size(); ++a) {
            const double of_node = polynomial(order, eight.positions.row(eight.neighbours[a].node).transpose());
            value += eight.neighbours[a].value[l] * of_node;
            for (int axis = 0; axis < 3; ++axis) {
              gradient[axis] += gradients[a].axis[axis][l] * of_node;
            }
          }
          Eigen::Vector3d expected = slope(order, x);
          expected[2] = dimensions == 3 ? expected[2] : 0;
          EXPECT_NEAR(value, polynomial(order, x), 1e-10);
          EXPECT_LE((gradient - expected).norm(), 1e-9);
        }
      }
    }
  }
}

/// The lanes do not see each other: a place gives the same bits whatever the others are.
TEST(MovingLeastSquares, OfAPlaceDoNotDependOnTheOthers) {
  EightPlaces eight = in_space(7), others = in_space(11);
  for (int axis = 0; axis < 3; ++axis) {
    others.places.at[axis][5] = eight.places.at[axis][2];
  }
  others.see();
  const FitOptions options{3, 2, 1e-7, false};
  fit_shape(eight.neighbours, options, eight.fit);
  fit_shape(others.neighbours, options, others.fit);
  const auto of_lane = [](const EightPlaces& places, int lane) {
    std::vector<std::pair<std::int32_t, double>> values;
    for (const Neighbour& s : places.neighbours) {
      if (s.supports(lane)) {
        values.emplace_back(s.node, s.value[lane]);
      }
    }
    return values;
  };
  EXPECT_EQ(of_lane(eight, 2), of_lane(others, 5));
  EXPECT_NE(of_lane(eight, 5), of_lane(others, 5));
}

TEST(MovingLeastSquares, AreNotAdmissibleWhereNodesDoNotFixTheBasis) {
  EightPlaces flat = in_plane();
  fit_shape(flat.neighbours, {3, 1, 0, false}, flat.fit);
  EXPECT_FALSE(any(flat.fit.admissible)) << "nodes in one plane, a basis of space";
  fit_shape(flat.neighbours, {2, 1, 0, false}, flat.fit);
  EXPECT_TRUE(any(flat.fit.admissible));
  EightPlaces few = in_space();
  few.see(0.3);  // at most three nodes each
  fit_shape(few.neighbours, {3, 1, 0, false}, few.fit);
  EXPECT_FALSE(any(few.fit.admissible));
}

TEST(MovingLeastSquares, LeaveQuadraticTermsToThePenaltyOnlyWhenTold) {
  EightPlaces eight = in_space();
  eight.see(0.6);  // about eleven nodes each, for ten quadratic terms
  const auto admissible = [&](const FitOptions& options) {
    fit_shape(eight.neighbours, options, eight.fit);
    int count = 0;
    for (int l = 0; l < lanes; ++l) {
      count += eight.fit.admissible[l] != 0 ? 1 : 0;
    }
    return count;
  };
  const int without = admissible({3, 2, 0, false});
  EXPECT_LT(without, lanes / 2);
  EXPECT_EQ(admissible({3, 2, 1e-7, false}), without) << "a small penalty does not determine what nodes do not";
  EXPECT_EQ(admissible({3, 2, 1e-7, true}), lanes);
}

TEST(MovingLeastSquares, BlendTheValuesOfTheNodes) {
  EightPlaces eight = in_space();
  fit_shape(eight.neighbours, {3, 1, 0, false}, eight.fit);
  Lane sum[3];
  blend(eight.neighbours, eight.positions, sum);
  for (int l = 0; l < lanes; ++l) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(sum[axis][l], eight.places.at[axis][l], 1e-11) << "the mean of the nodes' places is the place";
    }
  }
}

/// Values, derivatives and means of eight places by one instruction set, and what is admissible.
std::vector<double> found_by(const FitKernels& kernels, EightPlaces eight, const FitOptions& options) {
  eight.neighbours.resize(eight.candidates.node.size());
  eight.neighbours.resize(kernels.find(eight.candidates, 1, eight.places, eight.neighbours.data()));
  kernels.fit(eight.neighbours, options, eight.fit);
  std::vector<ShapeGradient> gradients(eight.neighbours.size());
  kernels.slopes(eight.neighbours, {}, options, Derivatives::full, eight.fit, gradients.data());
  Lane mean[3];
  kernels.mean(eight.neighbours, eight.positions, mean);
  std::vector<double> all;
  for (int l = 0; l < lanes; ++l) {
    all.insert(all.end(), {mean[0][l], mean[1][l], mean[2][l], static_cast<double>(eight.fit.admissible[l]),
                           static_cast<double>(eight.fit.count[l])});
    for (std::size_t a = 0; a < gradients.size(); ++a) {
      const Lane(&axis)[3] = gradients[a].axis;
      all.insert(all.end(), {eight.neighbours[a].value[l], axis[0][l], axis[1][l], axis[2][l]});
    }
  }
  return all;
}

TEST(MovingLeastSquares, AreTheSameByEveryInstructionSet) {
  for (const FitOptions& options :
       {FitOptions{3, 1, 0, false}, {3, 2, 0, false}, {3, 2, 1e-7, true}, {2, 1, 0, false}, {2, 2, 1e-7, true}}) {
    const EightPlaces eight = options.dimensions == 3 ? in_space() : in_plane();
    const std::vector<double> expected = found_by(fit_kernels().front(), eight, options);
    for (const FitKernels& kernels : fit_kernels()) {
      const std::vector<double> found = found_by(kernels, eight, options);
      ASSERT_EQ(found.size(), expected.size()) << kernels.name;
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_NEAR(found[i], expected[i], 1e-11) << kernels.name << ", order " << options.order << ", number " << i;
      }
    }
  }
}

}  // namespace brainshift::solve::moving_least_squares_test
