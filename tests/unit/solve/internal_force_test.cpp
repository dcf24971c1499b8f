// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/internal_force.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>

#include "solve/dynamics/nodal_mass.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve {
namespace {

using test::box_cells;
using test::irregular_box;
using test::random_points;

constexpr double side = 50;
const Material brain{3000, 0.49, 1000};
const Material soft{10, 0.1, 1000};

/// A box of two materials with all that internal_force() needs.
struct Body {
  NodeCloud cloud;
  std::vector<NeoHookean> laws = {NeoHookean(brain), NeoHookean(soft)};
  PointBlocks points;
  ForceScratch scratch;

  Body(Basis basis, bool shared_pressure, unsigned seed = 1)
      : cloud(irregular_box(7, side, 0.3, seed)), points(make(cloud, basis, shared_pressure)), scratch(points) {}

  static PointBlocks make(const NodeCloud& cloud, Basis basis, bool shared_pressure) {
    const IntegrationPoints at = integration_points(box_cells(5, side), 8, nullptr, {1});
    std::vector<std::int32_t> material(at.size());
    for (std::size_t p = 0; p < at.size(); ++p) {
      material[p] = at.positions(static_cast<Eigen::Index>(p), 0) > 0.62 * side ? 1 : 0;
    }
    const ShapeFunctions shape(cloud.positions, cloud.spacing, {.basis = basis});
    return point_blocks(at, shape.evaluate(at.positions, true), material, cloud.size(), shared_pressure);
  }

  NodalVectors force(const NodalVectors& parameters) {
    NodalVectors f(parameters.size());
    internal_force(points, laws, parameters, scratch, f);
    return f;
  }
  double energy(const NodalVectors& parameters) {
    force(parameters);
    return point_state(points, laws, scratch).strain_energy;
  }
  NodalVectors random_parameters(double amplitude) const {
    const Points random = random_points(static_cast<int>(cloud.size()), 1, 3);
    NodalVectors u(4 * cloud.size(), 0.0);
    for (std::size_t a = 0; a < cloud.size(); ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        u[4 * a + i] = amplitude * (random(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(i)) - 0.5);
      }
    }
    return u;
  }
};

double largest(const NodalVectors& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())).cwiseAbs().maxCoeff();
}

struct Variant {
  Basis basis;
  bool shared_pressure;
};
class InternalForce : public testing::TestWithParam<Variant> {
 protected:
  Body body() const { return {GetParam().basis, GetParam().shared_pressure}; }
};
INSTANTIATE_TEST_SUITE_P(Variants, InternalForce,
                         testing::Values(Variant{Basis::linear, true}, Variant{Basis::linear, false},
                                         Variant{Basis::modified_quadratic, true}));

TEST_P(InternalForce, IsZeroUnderARigidRotationBy90Degrees) {
  Body b = body();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  NodalVectors u(4 * b.cloud.size(), 0.0);
  for (std::size_t a = 0; a < b.cloud.size(); ++a) {
    const Eigen::Vector3d x = b.cloud.positions.row(static_cast<Eigen::Index>(a));
    Eigen::Vector3d::Map(&u[4 * a]) = turn * x - x + Eigen::Vector3d(5, 6, 7);
  }
  const double spacing = b.cloud.spacing[0];
  EXPECT_LE(largest(b.force(u)), 1e-8 * brain.youngs_modulus * spacing * spacing);
  EXPECT_NEAR(point_state(b.points, b.laws, b.scratch).smallest_jacobian, 1, 1e-10);
}

TEST_P(InternalForce, IsTheDerivativeOfTheStrainEnergy) {
  Body b = body();
  const NodalVectors u = b.random_parameters(1.5);
  const NodalVectors f = b.force(u);
  constexpr double step = 1e-5;
  for (std::size_t i = 0; i < u.size(); i += 37) {
    if (i % 4 == 3) {
      continue;
    }
    NodalVectors ahead = u, behind = u;
    ahead[i] += step;
    behind[i] -= step;
    EXPECT_NEAR((b.energy(ahead) - b.energy(behind)) / (2 * step), f[i], 1e-5 * largest(f));
  }
}

TEST_P(InternalForce, HasNoResultant) {
  Body b = body();
  const NodalVectors f = b.force(b.random_parameters(1.5));
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (std::size_t a = 0; a < b.cloud.size(); ++a) {
    sum += Eigen::Map<const Eigen::Vector4d>(&f[4 * a]);
  }
  EXPECT_LE(sum.norm(), 1e-9 * largest(f));
}

TEST_P(InternalForce, IsTheSameBitForBitForAnyNumberOfThreads) {
  Body b = body();
  const NodalVectors u = b.random_parameters(1.0);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const NodalVectors one = b.force(u);
  const double energy_of_one = b.energy(u);
  omp_set_num_threads(3);
  EXPECT_EQ(b.force(u), one);
  EXPECT_EQ(b.energy(u), energy_of_one);
  omp_set_num_threads(threads);
}

/// Largest eigenvalue of M⁻¹K by power iteration on force differences about the state u.
double largest_eigenvalue(Body& b, const NodalVectors& u, const std::vector<double>& mass) {
  NodalVectors v = b.random_parameters(1.0);
  const NodalVectors f0 = b.force(u);
  double eigenvalue = 0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double scale = 1e-6 / largest(v);
    NodalVectors moved = u;
    for (std::size_t i = 0; i < u.size(); ++i) {
      moved[i] += scale * v[i];
    }
    const NodalVectors f = b.force(moved);
    double stiffness = 0, inertia = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double kv = (f[i] - f0[i]) / scale;
      stiffness += v[i] * kv;
      inertia += mass[i / 4] * v[i] * v[i];
      v[i] = kv / mass[i / 4];
    }
    eigenvalue = stiffness / inertia;
    const double length = largest(v);
    for (double& x : v) {
      x /= length;
    }
  }
  return eigenvalue;
}

TEST_P(InternalForce, WithTheMassesOfRelaxationHasNoEigenvalueAboveOneAndIsNotFarBelow) {
  for (const double amplitude : {0.0, 1.5}) {
    Body b = body();
    const NodalVectors u = b.random_parameters(amplitude);
    b.force(u);
    const std::vector<double> mass = relaxation_mass(b.points, tangent_moduli(b.points, b.laws, b.scratch));
    const double eigenvalue = largest_eigenvalue(b, u, mass);
    EXPECT_LE(eigenvalue, 1.0);
    EXPECT_GE(eigenvalue, 0.05);
  }
}

TEST_P(InternalForce, CriticalStepOfEq25IsConservativeForThePhysicalMass) {
  Body b = body();
  std::vector<double> mass(b.cloud.size(), 0.0);  // each point's mass spread equally over its support
  constexpr double density = 1e-3;
  for (const Block& block : b.points.blocks) {
    for (std::int32_t i = block.first_patch; i < block.last_patch; ++i) {
      const Patch& patch = b.points.patches[static_cast<std::size_t>(i)];
      for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
        for (const std::uint16_t slot : b.points.slots_of(p)) {
          const auto node = b.points.slot_node[static_cast<std::size_t>(block.first_slot) + slot];
          mass[static_cast<std::size_t>(node)] +=
              density * b.points.volume[static_cast<std::size_t>(p)] / static_cast<double>(b.points.support_size(p));
        }
      }
    }
  }
  const std::vector<double> speed = {std::sqrt(b.laws[0].wave_modulus() / density),
                                     std::sqrt(b.laws[1].wave_modulus() / density)};
  const double exact = 2 / std::sqrt(largest_eigenvalue(b, NodalVectors(4 * b.cloud.size(), 0.0), mass));
  const double estimate = critical_step(b.points, speed);
  EXPECT_LE(estimate, exact);
  EXPECT_GE(estimate, 0.1 * exact);
}

}  // namespace
}  // namespace brainshift::solve
