// SPDX-License-Identifier: GPL-3.0-or-later

#include "solve/solve.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>

#include "solve/output/solution_file.hpp"
#include "solve/output/steps.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::solve_test {

using test::box_cells;
using test::box_tetrahedra;

constexpr double side = model_side;
constexpr int n = 7;

const Eigen::Matrix3d strain{{0.01, 0.004, 0}, {0.004, -0.006, 0.002}, {0, 0.002, -0.004}};

TEST(PatchTest, OnConformingTetrahedraIsPassedToATenThousandth) {
  Model model = box_model({}, 6);
  model.cells = box_tetrahedra(model.cloud, 6);
  SolveOptions options;
  options.tolerance = 1e-7;
  for (const Basis basis : {Basis::linear, Basis::modified_quadratic}) {
    options.shape.basis = basis;
    const SolveResult result = patch_test(model, options, strain);
    ASSERT_TRUE(result.measures.converged) << result.failure;
    EXPECT_LE(difference_from(result.solution, strain), 6e-5);  // up to 0.8 mm is imposed
  }
}

TEST(Solve, CarriesARigidRotationThroughWithoutStress) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(M_PI / 6, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Eigen::Matrix3d h = turn - Eigen::Matrix3d::Identity();
  const SolveResult result = patch_test(box_model(box_cells(n - 1, side)), {}, h);
  ASSERT_TRUE(result.measures.converged) << result.failure;
  EXPECT_LE(difference_from(result.solution, h), 0.01);
  EXPECT_NEAR(result.measures.largest_stretch, 1, 0.01);
}

TEST(Solve, StretchesACubeAsTheAnalyticSolutionSays) {
  for (const double stretch : {1.3, 0.8}) {
    SolveOptions options;
    options.shape.basis = Basis::linear;
    options.tolerance = 1e-4;
    const Model model = uniaxial(stretch);
    const SolveResult result = solve(model, options);
    ASSERT_TRUE(result.measures.converged) << result.failure;
    const auto [stress, lateral] = uniaxial_answer(model.materials.at(1), stretch);
    const Eigen::Matrix3d h = Eigen::Vector3d(lateral - 1, lateral - 1, stretch - 1).asDiagonal();
    EXPECT_LE(difference_from(result.solution, h), 1e-4 * side * std::abs(stretch - 1));
    double force = 0;
    for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
      force += model.cloud.positions(a, 2) > side - 1e-9 ? result.solution.reaction_force(a, 2) : 0;
    }
    const double expected = stress * side * side * 1e-6;  // N
    EXPECT_NEAR(force, expected, 1e-3 * std::abs(expected));
    EXPECT_NEAR(result.history.back().reaction.z(), force, 1e-12);  // the loaded nodes are those of the moved plate
  }
}

TEST(Solve, WorkExceedsTheStrainEnergyByWhatDampingTakesWhichHalvesWithTheRateOfLoading) {
  const auto excess = [](int load_steps) {
    SolveOptions options;
    options.load_steps = load_steps;
    const HistoryRow last = solve(uniaxial(1.2, 5), options).history.back();
    EXPECT_NEAR(last.external_work, last.strain_energy + last.kinetic_energy + last.dissipated_energy,
                1e-3 * last.external_work);
    return last.external_work - last.strain_energy;
  };
  const double fast = excess(800);
  EXPECT_GT(fast, 0);
  EXPECT_NEAR(excess(1600) / fast, 0.5, 0.05);
}

TEST(Solve, ErrorBoundBoundsTheError) {
  const Model model = uniaxial(1.2, 5);
  SolveOptions tight, loose;
  tight.tolerance = 1e-5;
  loose.tolerance = 0.05;
  const SolveResult exact = solve(model, tight);
  const SolveResult result = solve(model, loose);
  const double error = (exact.solution.displacement - result.solution.displacement).rowwise().norm().maxCoeff();
  EXPECT_LE(error, result.measures.error_bound + exact.measures.error_bound);
  EXPECT_LE(result.measures.error_bound, loose.tolerance);
  EXPECT_LE(result.measures.error_bound, 10 * error);
}

TEST(Solve, GivesTheSameBitsForAnyNumberOfThreads) {
  const Model model = uniaxial(1.1);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const SolveResult one = solve(model, {});
  omp_set_num_threads(3);
  const SolveResult three = solve(model, {});
  omp_set_num_threads(threads);
  EXPECT_EQ(one.solution.displacement, three.solution.displacement);
  EXPECT_EQ(one.solution.reaction_force, three.solution.reaction_force);
}

TEST(Solve, KeepsSnapshotsOnRequest) {
  SolveOptions options;
  options.snapshot_every = 100;
  const SolveResult result = solve(uniaxial(1.1, 5), options);
  ASSERT_GE(result.snapshots.size(), 4u);
  EXPECT_LT(result.snapshots[0].displacement.norm(), result.snapshots[2].displacement.norm());
  EXPECT_TRUE(solve(uniaxial(1.1, 5), {}).snapshots.empty());

  const test::ScratchFolder folder;
  write_steps(folder.path(), result);
  EXPECT_TRUE(std::filesystem::exists(folder / "steps.pvd"));
  EXPECT_EQ(read_solution(folder / "steps/000100.vtu").displacement, result.snapshots[0].displacement);
}

TEST(Solve, KeepsTheOrderOfTheNodes) {
  const Model model = uniaxial(1.1, 5);
  const SolveResult result = solve(model, {});
  EXPECT_EQ(result.solution.positions, model.cloud.positions);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > side - 1e-9) {
      EXPECT_NEAR(result.solution.displacement(a, 2), 0.1 * side, 1e-9);
    }
  }
}

/// Of itself, tried again more slowly, or not at all.
TEST(Solve, EndsALoadInFiveStepsWhereASlowOneEndsOrSaysThatItComesTooFast) {
  for (const double stretch : {0.95, 0.7, 0.6, 1.5}) {
    const Model model = uniaxial(stretch, 5);
    SolveOptions hasty;
    hasty.load_steps = 5;
    const SolveResult wanted = solve(model, {}), result = solve(model, hasty);
    ASSERT_TRUE(wanted.measures.converged) << stretch << ": " << wanted.failure;
    if (result.failure.empty()) {
      const double off = (result.solution.displacement - wanted.solution.displacement).rowwise().norm().maxCoeff();
      EXPECT_LE(off, result.measures.error_bound + wanted.measures.error_bound)
          << stretch << ", took '" << result.measures.took << "'";
    } else {
      EXPECT_NE(result.failure.find("the load comes too fast"), std::string::npos) << stretch << ": " << result.failure;
    }
  }
}

/// From the softest to the stiffest that is taken; in double precision, then with what the program takes of itself.
TEST(Solve, MovesABodyOfOneTissueAlikeHoweverStiffItIs) {
  SolveOptions exact, quickest;
  quickest.start = Start::coarse;
  quickest.precision = Precision::single_precision;
  for (const auto& [options, most] : {std::pair{exact, 1e-6}, {quickest, 1e-3}}) {
    Model model = uniaxial(0.8, 5);
    const SolveResult usual = solve(model, options);
    ASSERT_TRUE(usual.measures.converged) << usual.failure;
    for (const double modulus : {1e-6, 1e15}) {
      model.materials[1].youngs_modulus = modulus;
      const SolveResult result = solve(model, options);
      ASSERT_TRUE(result.measures.converged) << modulus << " Pa: " << result.failure;
      const double off = (result.solution.displacement - usual.solution.displacement).rowwise().norm().maxCoeff();
      EXPECT_LE(off, most) << modulus << " Pa";
      const double times = result.history.back().reaction.z() / usual.history.back().reaction.z();
      EXPECT_NEAR(times * 3000 / modulus, 1, 10 * most) << modulus << " Pa";
    }
  }
}

TEST(Solve, SaysWhyALoadThatTurnsTheBodyInsideOutFailed) {
  const SolveResult result = solve(uniaxial(-0.5, 5), {});
  EXPECT_FALSE(result.measures.converged);
  EXPECT_NE(result.failure.find("unstable at step"), std::string::npos) << result.failure;
  EXPECT_TRUE(result.solution.displacement.allFinite());
}

TEST(Solve, RefusesWhatCannotBeSolved) {
  const Model good = uniaxial(1.1);
  Model model = good;
  model.materials.clear();
  EXPECT_THROW(solve(model, {}), std::invalid_argument);
  model = good;
  model.materials[1].poisson_ratio = 0.5;
  EXPECT_THROW(solve(model, {}), std::invalid_argument);
  model = good;
  model.materials[1].youngs_modulus = -1;
  EXPECT_THROW(solve(model, {}), std::invalid_argument);
  model = good;
  model.conditions.displacement.setConstant(std::nan(""));
  EXPECT_THROW(solve(model, {}), std::invalid_argument);
  model = good;
  model.conditions.displacement.leftCols<2>().setConstant(std::nan(""));  // free to slide and turn
  EXPECT_THROW(solve(model, {}), std::invalid_argument);
}

}  // namespace brainshift::solve::solve_test
