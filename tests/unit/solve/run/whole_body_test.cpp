// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/whole_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/move_surface.hpp"
#include "tests/unit/solve/pressed_bar.hpp"

namespace brainshift::solve::whole_body_test {

TEST(CoarseStart, EndsWhereTheStartFromRestEndsInFewerSteps) {
  const Model model = pressed_bar();
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.tolerance = 0.02;
  const SolveResult from_rest = solve_whole_body(model, options, {});
  options.start = Start::coarse;
  const SolveResult from_coarse = solve_whole_body(model, options, {});
  ASSERT_TRUE(from_coarse.failure.empty()) << from_coarse.failure;
  EXPECT_LT(from_coarse.measures.steps, 3 * from_rest.measures.steps / 4);
  EXPECT_LT(largest_difference_of(from_coarse, from_rest), 2 * options.tolerance);
  EXPECT_EQ(from_coarse.history.front().time, 1) << "under the full load from the beginning on";
  EXPECT_LT(from_rest.history.front().time, 1);
  const HistoryRow& first = from_coarse.history.front();
  EXPECT_EQ(first.dissipated_energy, 0) << "the books begin there";
  EXPECT_NEAR(first.strain_energy + first.kinetic_energy, first.external_work, 1e-12 * first.external_work);
  EXPECT_NEAR(from_coarse.history.back().strain_energy, from_rest.history.back().strain_energy,
              0.01 * from_rest.history.back().strain_energy);
  for (const HistoryRow& row : from_coarse.history) {
    EXPECT_NEAR(row.strain_energy + row.kinetic_energy + row.dissipated_energy, row.external_work,
                0.005 * row.external_work)
        << "at step " << row.step;
  }
}

/// A cube turned by half a circle by three of its corners turns so slowly that the fine body's steps do not show it.
TEST(CoarseStart, SaysWhatItsSlowestMotionsLeftOpen) {
  constexpr int n = 8;
  Model model = box_model(test::box_cells(n - 1, model_side), n);
  Points turned = -2 * model.cloud.positions;
  turned.leftCols<2>().array() += model_side;
  turned.col(2).setZero();
  for (const Eigen::RowVector3d& corner :
       {Eigen::RowVector3d(0, 0, 0), Eigen::RowVector3d(model_side, 0, 0), Eigen::RowVector3d(0, model_side, 0)}) {
    Eigen::Index node = 0;
    (model.cloud.positions.rowwise() - corner).rowwise().norm().minCoeff(&node);
    model.conditions.displacement.row(node) = turned.row(node);
  }
  SolveOptions options;
  options.start = Start::coarse;
  const SolveResult result = solve_whole_body(model, options, {});
  ASSERT_TRUE(result.failure.empty()) << result.failure;
  EXPECT_LT(result.measures.steps, 1000) << "from rest it takes 19,200";
  EXPECT_LE((result.solution.displacement - turned).rowwise().norm().maxCoeff(), result.measures.error_bound);
  EXPECT_LE(result.measures.error_bound, options.tolerance);
}

/// By how much the first row's strain energy differs from the last one's.
double way_of(const SolveResult& result) {
  return std::abs(result.history.front().strain_energy - result.history.back().strain_energy);
}

TEST(LastStart, GoesOnFromAStateOfAnotherCloudAndEndsWhereTheOthersEnd) {
  Model model = pressed_bar();
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.tolerance = 0.02;
  options.start = Start::coarse;
  const SolveResult from_coarse = solve_whole_body(model, options, {});
  const Solution last = from_coarse.solution;
  const Eigen::Index some = last.positions.rows() - 7;  // another cloud: the field is looked up at the nodes
  for (const Eigen::Index nodes : {last.positions.rows(), some}) {
    Solution part = last;
    part.positions.conservativeResize(nodes, 3);
    part.displacement.conservativeResize(nodes, 3);
    part.spacing.resize(static_cast<std::size_t>(nodes));
    model.last = part;
    const SolveResult result = solve_whole_body(model, options, {});
    ASSERT_TRUE(result.failure.empty()) << result.failure;
    EXPECT_LT(way_of(result), 0.2 * way_of(from_coarse)) << "it begins where it ends; nodes: " << nodes;
    EXPECT_LE(result.measures.steps, from_coarse.measures.steps) << nodes;
    EXPECT_LT(largest_difference_of(result, from_coarse), 2 * options.tolerance) << nodes;
  }
}

TEST(CoarseStart, IsFromRestWhereTheWayThereIsWanted) {
  const Model model = pressed_bar();
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.start = Start::coarse;
  options.snapshot_every = 100;
  options.max_steps = 50;  // it need not come to rest
  EXPECT_LT(solve_whole_body(model, options, {}).history.front().time, 1);
}

TEST(CoarseStart, IsFromRestWhereTheLoadDoesNotEndInFull) {
  Model model = pressed_bar();
  model.curve = LoadCurve({0, 1}, {0, 0.5}, LoadCurve::Join::smooth);
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.max_steps = 50;
  const SolveResult from_rest = solve_whole_body(model, options, {});
  options.start = Start::coarse;
  const SolveResult result = solve_whole_body(model, options, {});
  EXPECT_EQ(result.measures.seconds_coarse, 0);
  EXPECT_EQ(largest_difference_of(result, from_rest), 0);
}

/// Held at three neighbours, of which a coarse cloud has one.
TEST(CoarseStart, IsFromRestWhereTissueCreases) {
  const Model model = uniaxial(0.5, 6);
  SolveOptions options;
  options.start = Start::coarse;
  const SolveResult result = solve_whole_body(model, options, {});
  ASSERT_GT(result.measures.compressed_share, much_compressed);
  EXPECT_EQ(result.measures.took, "the load from rest, as the tissue creases");
  options.start = Start::rest;
  const SolveResult from_rest = solve_whole_body(model, options, {});
  EXPECT_EQ(from_rest.measures.took, "");
  EXPECT_EQ(result.solution.displacement, from_rest.solution.displacement);
}

TEST(CoarseStart, IsFromRestWhereTheCoarseCloudIsNotHeld) {
  Model model = pressed_bar();
  const Eigen::Index corner = 9 * 9 * 20;
  model.conditions.displacement.setConstant(std::nan(""));
  for (const Eigen::Index node : {corner, corner + 1, corner + 9}) {
    model.conditions.displacement.row(node).setZero();
  }
  model.gravity = {0, 0, 0.01};
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.max_steps = 40;  // it need not come to rest
  const SolveResult from_rest = solve_whole_body(model, options, {});
  options.start = Start::coarse;
  const SolveResult result = solve_whole_body(model, options, {});
  EXPECT_GT(result.measures.seconds_coarse, 0);
  EXPECT_GT(result.measures.largest_displacement, 0);
  EXPECT_EQ(largest_difference_of(result, from_rest), 0);
}

TEST(WholeBody, IsLoadedMoreSlowlyBeforeItIsGivenUp) {
  SolveOptions hasty;
  hasty.load_steps = 10;
  const SolveResult result = solve_whole_body(uniaxial(0.5, 5), hasty, {});
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.measures.took, "50 load steps");
}

/// A body that is loaded in ten steps, with steps enough to see that this does not go, but not for a slower load.
struct OutOfSteps {
  std::vector<std::string> attempts;  // as they were told
  SolveResult result;
  std::string steps;

  OutOfSteps(const Model& model, SolveOptions options) {
    options.load_steps = 10;
    options.max_steps = 0;
    while (attempts.empty() && options.max_steps < 200) {
      options.max_steps += 20;
      result = solve_whole_body(model, options, [&](double, std::string_view what) {
        if (what.starts_with("not at rest; ")) {
          attempts.emplace_back(what);
        }
      });
    }
    steps = std::to_string(options.max_steps) + " steps";
  }
};

TEST(WholeBody, GoesOnWhereASlowerLoadRunsOutOfSteps) {
  SolveOptions single;
  single.precision = Precision::single_precision;
  const auto [attempts, result, steps] = OutOfSteps(uniaxial(0.5, 5), single);
  const std::vector<std::string> wanted = {"not at rest; once more with 50 load steps",
                                           "not at rest; once more with 50 load steps, linear shape functions",
                                           "not at rest; once more with 50 load steps, double precision"};
  EXPECT_EQ(attempts, wanted);
  EXPECT_EQ(result.measures.took, "50 load steps") << "it came farthest";
  EXPECT_NE(result.failure.find("not converged after " + steps), std::string::npos) << result.failure;
  EXPECT_NE(result.failure.find("tried in vain with 50 load steps (" + steps + "), with 50 load steps, linear shape"),
            std::string::npos)
      << result.failure;
}

/// Above a contrast of 1 : 10⁵ a slower load may end, but several times too stiff.
TEST(WholeBody, IsGivenUpAtOnceWhereNoLoadIsSlowEnoughForItsContrast) {
  Model model = uniaxial(-0.5, 5);
  for (std::size_t cell = 0; cell < model.cells.size(); cell += 2) {
    model.cells.label[cell] = 2;
  }
  model.materials[2] = {3e9, 0.49, 1000};
  const SolveResult result = solve_whole_body(model, {}, {});
  EXPECT_NE(result.failure, "");
  EXPECT_EQ(result.failure.find("tried in vain"), std::string::npos) << result.failure;
  model.materials[2].youngs_modulus = 3e7;
  EXPECT_NE(solve_whole_body(model, {}, {}).failure.find("tried in vain with 2000 load steps ("), std::string::npos);
}

/// A bar of 60 mm that is held at one end and bends by a third of its length. Its bending is so slow a motion, A_0
/// about 1e-6, that rounding of the forces leaves it a hundredth of a millimetre off: far more than the tolerance.
TEST(WholeBody, TakesDoublePrecisionWhereSingleDoesNotEnd) {
  constexpr double h = 5;
  Model model;
  model.cloud.positions.resize(9 * 13, 3);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x(static_cast<double>(a % 3), static_cast<double>(a / 3 % 3), static_cast<double>(a / 9));
    model.cloud.positions.row(a) = h * x;
    model.cloud.on_surface.push_back(x[0] == 1 && x[1] == 1 && x[2] > 0 && x[2] < 12 ? 0 : 1);
  }
  model.cloud.spacing.assign(model.cloud.on_surface.size(), h);
  model.conditions = test::all_free(model.cloud);
  model.conditions.displacement.topRows<9>().setZero();
  model.cells = test::box_cells({2, 2, 12}, {2 * h, 2 * h, 12 * h});
  model.materials[1] = {3000, 0.498, 1000};
  model.gravity = {0.3, 0, 0};
  SolveOptions options;
  options.precision = Precision::single_precision;
  options.tolerance = 6.1e-4;  // a smaller one is asked of double precision at once
  const SolveResult result = solve_whole_body(model, options, {});
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.measures.took, "double precision");
  EXPECT_FALSE(result.measures.single_precision);
}

/// All of the surface is moved so that the volume changes, against a pressure of many shear moduli.
Model confined(double change) {
  Model model = box_model(test::box_cells(6, model_side), 6);
  model.materials[1].poisson_ratio = 0.499;
  const Eigen::Matrix3d sheared{{1, 0.1, 0.05}, {-0.08, 1, 0.1}, {0.1, -0.05, 1}};
  const Eigen::Matrix3d gradient = std::cbrt((1 + change) / sheared.determinant()) * sheared;
  test::move_surface(model, gradient - Eigen::Matrix3d::Identity());
  return model;
}

double distance_from_homogeneous(const Model& model, const Points& displacement) {
  const Eigen::MatrixXd x = model.cloud.positions;
  std::vector<Eigen::Index> held;
  for (Eigen::Index a = 0; a < x.rows(); ++a) {
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] != 0) {
      held.push_back(a);
    }
  }
  const Eigen::MatrixXd u = displacement(held, Eigen::all), at = x(held, Eigen::all);
  const Eigen::MatrixXd slope = at.colPivHouseholderQr().solve(u);
  return (displacement - x * slope).cwiseAbs().maxCoeff();
}

TEST(WholeBody, IsPointwiseWhereThePrescribedVolumePutsItUnderHighPressure) {
  const Model little = confined(-0.005), much = confined(-0.09);
  const SolveResult patches = solve_whole_body(little, {}, {}), pointwise = solve_whole_body(much, {}, {});
  EXPECT_EQ(patches.failure + pointwise.failure, "");
  EXPECT_EQ(patches.measures.took, "");
  EXPECT_EQ(patches.measures.pressed_share, 0);
  EXPECT_LT(distance_from_homogeneous(little, patches.solution.displacement), 0.02);
  EXPECT_NE(pointwise.measures.took.find("pointwise"), std::string::npos);
  EXPECT_LT(distance_from_homogeneous(much, pointwise.solution.displacement), 0.02);
}

/// Of a soft core in a stiff block it is the block that says what becomes of its volume.
TEST(WholeBody, SaysThatATissueIsUnderHighPressureWhereTheSurfaceIsFree) {
  Model model = uniaxial(0.8, 7);
  EXPECT_EQ(solve_whole_body(model, {}, {}).measures.pressed_share, 0);
  test::label_cells(model.cells,
                    [](const Eigen::RowVector3d& low) { return low.minCoeff() > 19 && low.maxCoeff() < 31 ? 2 : 1; });
  model.materials[1].poisson_ratio = 0.3;
  model.materials[2] = {0.3, 0.49, 1000};
  const SolveResult result = solve_whole_body(model, {}, {});
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.measures.pressed_share, much_pressed);
}

/// A sheet of two layers of nodes, its end moved along it by so much, mm.
Model sheet(double pull) {
  constexpr int n = 10;
  constexpr double h = 4;
  Model model;
  model.cloud.positions.resize(2 * n * n, 3);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    model.cloud.positions.row(a) << h * static_cast<double>(a % n), h * static_cast<double>(a / n % n),
        h * static_cast<double>(a / (n * n));
  }
  model.cloud.spacing.assign(model.cloud.size(), h);
  model.cloud.on_surface.assign(model.cloud.size(), 1);
  model.conditions = test::all_free(model.cloud);
  model.cells = test::box_cells({n - 1, n - 1, 1}, {(n - 1) * h, (n - 1) * h, h});
  model.materials[1] = {3000, 0.45, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (a % n == 0 || a % n == n - 1) {
      model.conditions.displacement.row(a) << (a % n == 0 ? 0 : pull), 0, 0;
    }
  }
  return model;
}

TEST(WholeBody, TakesLinearShapeFunctionsForACloudThatIsTooThinForQuadraticOnes) {
  const Model model = sheet(2);
  const SolveResult quadratic = solve_whole_body(model, {}, {});
  SolveOptions linear;
  linear.shape.basis = Basis::linear;
  const SolveResult wanted = solve_whole_body(model, linear, {});
  ASSERT_EQ(quadratic.failure, "");
  EXPECT_NE(quadratic.measures.took.find("too thin for quadratic"), std::string::npos);
  EXPECT_EQ(largest_difference_of(quadratic, wanted), 0);
  EXPECT_EQ(quadratic.solution.shape.basis, Basis::linear);
  EXPECT_EQ(solve_whole_body(uniaxial(0.95, 5), {}, {}).measures.took, "");
}

/// Linear shape functions are no further attempt for it, and do not go unsaid after one.
TEST(WholeBody, SaysAllThatAThinCloudTook) {
  const auto [attempts, result, steps] = OutOfSteps(sheet(-18), {});
  EXPECT_EQ(attempts, std::vector<std::string>{"not at rest; once more with 50 load steps"});
  EXPECT_EQ(result.measures.took, "50 load steps; linear shape functions, as the cloud is too thin for quadratic ones");
}

TEST(WholeBody, SaysWhatItDoesAndHowLongItTook) {
  SolveOptions options;
  options.start = Start::coarse;
  options.shape.basis = Basis::linear;
  options.tolerance = 0.1;
  std::vector<std::string> told;
  double last = 0;
  const SolveResult result = solve_whole_body(pressed_bar(), options, [&](double fraction, std::string_view what) {
    EXPECT_TRUE(fraction >= 0 && fraction <= 1);
    last = fraction;
    if (told.empty() || told.back() != what) {
      told.emplace_back(what);
    }
  });
  EXPECT_NE(std::find(told.begin(), told.end(), "solving a coarse cloud"), told.end());
  EXPECT_GT(last, 0.5);
  for (const double seconds :
       {result.measures.seconds_setup, result.measures.seconds_coarse, result.measures.seconds_stepping}) {
    EXPECT_GT(seconds, 0);
  }
}

TEST(WholeBody, WithoutItsResectionIsTheRest) {
  Model model = uniaxial(1.1, 7);
  test::label_cells(model.cells, [](const Eigen::RowVector3d& low) { return low[2] > 0.7 * model_side ? 2 : 1; });
  model.materials[2] = model.materials[1];
  EXPECT_FALSE(solve_whole_body(model, {}, {}).measures.resection);
  model.resection = Resection{.labels = {2}};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > 0.7 * model_side) {
      model.conditions.displacement.row(a).setConstant(std::nan(""));
    }
  }
  const SolveResult result = solve_whole_body(model, {}, {});
  ASSERT_TRUE(result.measures.resection);
  EXPECT_NEAR(result.measures.resection->removed_volume, std::pow(model_side, 3) / 6, 1e-6);
  EXPECT_EQ(result.measures.resection->removed_nodes + result.measures.nodes, model.cloud.size());
  EXPECT_GT(result.measures.resection->removed_nodes, 0U);
  EXPECT_LT(result.measures.largest_displacement, 0.01) << "nothing pulls at what is left";
}

}  // namespace brainshift::solve::whole_body_test
