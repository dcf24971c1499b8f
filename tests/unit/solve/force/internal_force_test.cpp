// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/force/internal_force.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>

#include "solve/force/patch_dilatation.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "tests/unit/solve/material_cases.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::internal_force_test {

using test::box_cells;
using test::irregular_box;
using test::irregular_rectangle;
using test::rectangle_cells;

constexpr double side = 50;
const Material soft{.youngs_modulus = 10, .poisson_ratio = 0.1};

enum class Kind : std::uint8_t { patches, pointwise, quadratic, plane_strain };

Specimen make_specimen(Kind kind, const Material& material) {
  SpecimenOptions options{.nodes_per_patch = kind == Kind::pointwise ? 0.0 : 6.0};
  if (kind == Kind::plane_strain) {
    options.points_per_cell = 4;
    return {irregular_rectangle(7, 7, side, side, 0.3), rectangle_cells(8, 8, side, side), {material, soft}, options};
  }
  options.basis = kind == Kind::quadratic ? Basis::modified_quadratic : Basis::linear;
  return {irregular_box(6, side, 0.3), box_cells(4, side), {material, soft}, options};
}

using Case = std::tuple<Kind, Material>;

class InternalForce : public testing::TestWithParam<Case> {
 protected:
  Specimen body = make_specimen(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const Material& material() const { return std::get<1>(GetParam()); }
  bool planar() const { return std::get<0>(GetParam()) == Kind::plane_strain; }
  /// A force that is not small: of a strain of one over a spacing squared.
  double unit() const { return material().youngs_modulus * body.cloud.spacing[0] * body.cloud.spacing[0]; }
};

std::string name_of_case(const testing::TestParamInfo<Case>& tested) {
  const std::string kinds[] = {"patches", "pointwise", "quadratic", "plane_strain"};
  return kinds[static_cast<int>(std::get<0>(tested.param))] + "_" + name_of(std::get<1>(tested.param));
}

INSTANTIATE_TEST_SUITE_P(Patches, InternalForce,
                         testing::Combine(testing::Values(Kind::patches, Kind::plane_strain),
                                          testing::ValuesIn(every_law)),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Others, InternalForce,
                         testing::Combine(testing::Values(Kind::pointwise, Kind::quadratic),
                                          testing::Values(every_law.front(), every_law.back())),
                         name_of_case);

TEST_P(InternalForce, SharesPressureOverPatchesOfSeveralPointsWhenAsked) {
  const double per_patch = static_cast<double>(body.points.points()) / static_cast<double>(body.points.patches.size());
  if (std::get<0>(GetParam()) == Kind::pointwise) {
    EXPECT_EQ(per_patch, 1);
  } else {
    EXPECT_GE(per_patch, 5);
  }
}

TEST_P(InternalForce, IsZeroUnderARigidTranslation) {
  NodalVectors u = body.rest();
  for (std::size_t a = 0; a < body.cloud.size(); ++a) {
    at(u, a).head<3>() << 5, -6, planar() ? 0 : 7;
  }
  EXPECT_LE(largest(body.force(u)), 1e-8 * unit());
  EXPECT_LE(body.energy(u), 1e-10 * unit());
}

TEST_P(InternalForce, IsZeroUnderARigidRotationBy90Degrees) {
  const Eigen::Vector3d axis = planar() ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(1, -2, 0.5).normalized();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(M_PI / 2, axis).toRotationMatrix();
  const double force = largest(body.force(body.linear(turn - Eigen::Matrix3d::Identity())));
  if (material().law == Law::linear_elastic) {
    EXPECT_GE(force, 0.01 * unit());  // it takes a rotation for a strain
    return;
  }
  EXPECT_LE(force, 1e-8 * unit());
  EXPECT_NEAR(point_state(body.points, body.laws, body.scratch).smallest_jacobian, 1, 1e-10);
}

TEST_P(InternalForce, IsTheDerivativeOfTheStrainEnergy) {
  const NodalVectors u = body.random_parameters(0.8);
  const NodalVectors f = body.force(u);
  constexpr double step = 1e-5;
  for (std::size_t i = 0; i < u.size(); i += 37) {
    if (i % 4 < (planar() ? 2 : 3)) {
      NodalVectors ahead = u, behind = u;
      ahead[i] += step;
      behind[i] -= step;
      EXPECT_NEAR((body.energy(ahead) - body.energy(behind)) / (2 * step), f[i], 1e-5 * largest(f));
    }
  }
}

TEST_P(InternalForce, HasNoResultant) {
  const NodalVectors f = body.force(body.random_parameters(0.8));
  EXPECT_LE(resultant(f).norm(), 1e-9 * largest(f));
}

TEST_P(InternalForce, IsTheSameBitForBitForAnyNumberOfThreads) {
  const NodalVectors u = body.random_parameters(0.8);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const NodalVectors one = body.force(u);
  const double energy_of_one = body.energy(u);
  omp_set_num_threads(3);
  EXPECT_EQ(body.force(u), one);
  EXPECT_EQ(body.energy(u), energy_of_one);
  omp_set_num_threads(threads);
}

/// What is kept in single precision is off by its rounding and no more.
TEST(SinglePrecision, IsNearDouble) {
  for (const Material& material : {every_law.front(), every_law.back()}) {
    const auto body = [&](Precision precision) {
      return Specimen{
          irregular_box(6, side, 0.3), box_cells(4, side), {material}, SpecimenOptions{.precision = precision}};
    };
    Specimen kept_double = body(Precision::double_precision), kept_single = body(Precision::single_precision);
    EXPECT_TRUE(kept_single.points.pair_derivative.empty());
    const NodalVectors u = kept_double.random_parameters(0.8), expected = kept_double.force(u);
    const NodalVectors f = kept_single.force(u);
    double difference = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
      difference = std::max(difference, std::abs(f[i] - expected[i]));
    }
    EXPECT_GT(difference, 0);
    EXPECT_LE(difference, 1e-5 * largest(expected)) << name_of(material);
    const std::vector<double> bound = stiffness_bound(kept_single.points, kept_single.laws, kept_single.scratch);
    const std::vector<double> expected_bound =
        stiffness_bound(kept_double.points, kept_double.laws, kept_double.scratch);
    for (std::size_t a = 0; a < bound.size(); ++a) {
      EXPECT_NEAR(bound[a], expected_bound[a], 1e-5 * expected_bound[a]);
    }
  }
}

/// The projection takes energy of the dilatation away (Bessel), none of one that is uniform.
TEST(SharedPressure, NeverStoresMoreThanPointwise) {
  for (const Material& material : every_law) {
    Specimen shared = make_specimen(Kind::patches, material), pointwise = make_specimen(Kind::pointwise, material);
    for (const unsigned seed : {1u, 2u, 3u}) {
      const NodalVectors u = shared.random_parameters(0.8, seed);
      EXPECT_LE(shared.energy(u), pointwise.energy(u) * (1 + 1e-12)) << name_of(material);
    }
    const NodalVectors uniform = shared.linear(Eigen::Matrix3d{{0.1, 0.2, 0}, {0, -0.05, 0.1}, {0.1, 0, 0.2}});
    const double expected = pointwise.energy(uniform);
    EXPECT_NEAR(shared.energy(uniform), expected, 1e-10 * expected) << name_of(material);
  }
}

/// Points that are nearly flat: the force still comes from an energy, and that of the barrier is what is added.
TEST(Barrier, PushesPointsBackThatAreNearlyFlat) {
  Specimen body{irregular_box(6, side, 0.3), box_cells(4, side), {Material{}}, SpecimenOptions{}};
  const auto squeezed = [&](double to) { return body.linear(Eigen::Vector3d(0, 0, to - 1).asDiagonal()); };
  const NodalVectors u = squeezed(0.03), direction = squeezed(0);
  const NodalVectors f = body.force(u);
  EXPECT_NEAR(jacobian_range(body.scratch).smallest, 0.03, 1e-6);
  constexpr double step = 1e-5;
  double work = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    work += f[i] * direction[i];
  }
  const double slope = (body.energy(squeezed(0.03 - step)) - body.energy(squeezed(0.03 + step))) / (2 * step);
  EXPECT_NEAR(slope, work, 1e-4 * work);

  const double volume = std::accumulate(body.points.volume.begin(), body.points.volume.end(), 0.0);
  const NeoHookean law{Material{}};
  const Deformation flat(Eigen::Vector3d(1, 1, 0.03).asDiagonal());
  const double of_law = law.isochoric_energy(flat) + law.bulk_modulus / 2 * 0.97 * 0.97;
  const double barrier = law.shear_modulus * std::pow(std::log(0.03 / barrier_jacobian(law)), 2);
  EXPECT_NEAR(body.energy(u), volume * (of_law + barrier), 1e-6 * volume * of_law);
}

}  // namespace brainshift::solve::internal_force_test
