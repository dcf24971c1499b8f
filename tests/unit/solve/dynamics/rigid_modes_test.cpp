// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/rigid_modes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::rigid_modes_test {

using Matrix = RigidModes::Matrix;

/// Random nodes, of which the first ten are held, with random masses.
struct Body {
  Points positions = test::random_points(200, 50, 4);
  std::vector<std::int32_t> held = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::vector<double> mass;
  RigidModes modes{positions, held};
  NodalVectors rest = NodalVectors(800, 0.0);

  Body() {
    const Points random = test::random_points(200, 1, 5);
    for (Eigen::Index a = 0; a < random.rows(); ++a) {
      mass.push_back(1 + std::abs(random(a, 0)));
    }
  }

  NodalVectors random_vectors(unsigned seed) const {
    const Points random = test::random_points(200, 1, seed);
    NodalVectors v = rest;
    for (std::size_t a = 0; a < 200; ++a) {
      at(v, a).head<3>() = random.row(static_cast<Eigen::Index>(a)).transpose();
    }
    return v;
  }

  double inertia(const NodalVectors& v) const {
    return sum_over_nodes(200, [&](std::size_t a) { return mass[a] * at(v, a).squaredNorm(); });
  }
};

TEST(RigidModes, AreTheInverseOfTheMassesThatTheyStandFor) {
  Body body;
  body.modes.weigh(body.mass, Matrix::Zero(12, 12), Matrix::Zero(12, 12));
  const NodalVectors v = body.random_vectors(6);
  NodalVectors step = v;
  body.modes.lighten(body.mass, step);                         // M⁻¹ P⁻¹ v
  body.modes.add(body.mass, 0.5, body.rest, body.rest, step);  // P P⁻¹ v
  EXPECT_LE(largest_difference(step, v), 1e-9);
}

TEST(RigidModes, TakeOffTheInertiaWhatTheyAddToTheStep) {
  Body body;
  body.modes.weigh(body.mass, Matrix::Zero(12, 12), Matrix::Zero(12, 12));
  const NodalVectors v = body.random_vectors(7);
  NodalVectors light = v;
  body.modes.lighten(body.mass, light);
  const double inertia = sum_over_nodes(200, [&](std::size_t a) { return body.mass[a] * at(v, a).dot(at(light, a)); });
  const double less = body.modes.less_inertia(body.mass, v, body.rest);
  EXPECT_GT(less, 0.01 * body.inertia(v));
  EXPECT_NEAR(body.inertia(v) - less, inertia, 1e-9 * body.inertia(v));
}

TEST(RigidModes, LeaveTheHeldNodesAndTheStateAtRestAlone) {
  Body body;
  body.modes.weigh(body.mass, Matrix::Zero(12, 12), Matrix::Zero(12, 12));
  const NodalVectors v = body.random_vectors(8);
  NodalVectors step = v;
  body.modes.add(body.mass, 0.5, body.rest, body.rest, step);
  for (const std::int32_t a : body.held) {
    EXPECT_EQ(at(step, static_cast<std::size_t>(a)), at(v, static_cast<std::size_t>(a)));
  }
  EXPECT_GT(largest_difference(step, v), 1);
  NodalVectors same = v;
  body.modes.add(body.mass, 0.5, v, v, same);
  EXPECT_EQ(same, v);
}

TEST(RigidModes, MakeAFreeBodyAHundredTimesLighterInRigidMotions) {
  Body body;
  RigidModes modes(body.positions, {});
  modes.weigh(body.mass, Matrix::Zero(12, 12), Matrix::Zero(12, 12));
  NodalVectors turn = body.rest;
  for (std::size_t a = 0; a < 200; ++a) {
    const Eigen::Vector3d x = body.positions.row(static_cast<Eigen::Index>(a));
    at(turn, a).head<3>() = Eigen::Vector3d(1, 2, 3) + Eigen::Vector3d(0.3, -0.1, 0.2).cross(x);
  }
  EXPECT_NEAR(modes.less_inertia(body.mass, turn, body.rest), 100.0 / 101 * body.inertia(turn),
              1e-9 * body.inertia(turn));
}

/// Nodes 100 to 149 move together and are lighter so; what moves them one by one is as heavy as before.
TEST(RigidModes, HaveThoseOfEachStiffPart) {
  Body body;
  std::vector<std::int32_t> part(50);
  std::iota(part.begin(), part.end(), 100);
  RigidModes modes(body.positions, body.held, std::vector<std::vector<std::int32_t>>(1, part));
  EXPECT_EQ(modes.motions(), 18);
  modes.weigh(body.mass, Matrix::Zero(18, 18), Matrix::Zero(18, 18));
  NodalVectors turn = body.rest;
  for (const std::int32_t a : part) {
    const Eigen::Vector3d x = body.positions.row(a);
    at(turn, static_cast<std::size_t>(a)).head<3>() =
        Eigen::Vector3d(1, 2, 3) + Eigen::Vector3d(0.3, -0.1, 0.2).cross(x);
  }
  EXPECT_NEAR(modes.less_inertia(body.mass, turn, body.rest), 100.0 / 101 * body.inertia(turn),
              1e-9 * body.inertia(turn));
  NodalVectors one = body.rest;
  at(one, 120)[0] = 1;
  EXPECT_LT(modes.less_inertia(body.mass, one, body.rest), 0.3 * body.inertia(one));
}

/// All nodes on springs of this many times their mass: every eigenvalue of M⁻¹K.
Matrix springs(const Body& body, double eigenvalue) {
  NodalVectors force(800);
  return body.modes.stiffness(
      [&](const NodalVectors& moved) -> const NodalVectors& {
        for (std::size_t a = 0; a < 200; ++a) {
          at(force, a) = eigenvalue * body.mass[a] * at(moved, a) + Eigen::Vector4d(1, 2, 3, 0);
        }
        return force;
      },
      0.1);
}

TEST(RigidModes, GiveSlowMotionsTheEigenvalueOfQuickOnes) {
  Body body;
  const double slow = RigidModes::quick / 20;
  body.modes.weigh(body.mass, springs(body, slow), Matrix::Zero(12, 12));
  NodalVectors shift = body.rest;  // in W: what a push makes of a body at rest
  NodalVectors push = body.random_vectors(9);
  body.modes.add(body.mass, 0, body.rest, body.rest, push);
  const NodalVectors random = body.random_vectors(9);
  for (std::size_t i = 0; i < shift.size(); ++i) {
    shift[i] = push[i] - random[i];
  }
  const double inertia = body.inertia(shift);
  EXPECT_NEAR(inertia - body.modes.less_inertia(body.mass, shift, body.rest), inertia / 20, 1e-6 * inertia);
}

TEST(RigidModes, LeaveQuickMotionsAlone) {
  Body body;
  body.modes.weigh(body.mass, springs(body, 2 * RigidModes::quick), Matrix::Zero(12, 12));
  const NodalVectors v = body.random_vectors(10);
  NodalVectors step = v;
  body.modes.add(body.mass, 0.5, body.rest, body.rest, step);
  EXPECT_EQ(step, v);
}

TEST(RigidModes, LetContactRaiseTheLargestEigenvalueByATenthAtMost) {
  Body body;
  const double contact = 0.05;
  body.modes.weigh(body.mass, Matrix::Zero(12, 12), springs(body, contact));
  const NodalVectors v = body.random_vectors(11);
  NodalVectors push = v;
  body.modes.add(body.mass, 0, body.rest, body.rest, push);
  NodalVectors added = body.rest;
  for (std::size_t i = 0; i < added.size(); ++i) {
    added[i] = push[i] - v[i];
  }
  const double gain = 0.1 / contact, inertia = body.inertia(added);
  EXPECT_NEAR(inertia - body.modes.less_inertia(body.mass, added, body.rest), inertia / (1 + gain), 1e-6 * inertia);
}

}  // namespace brainshift::solve::rigid_modes_test
