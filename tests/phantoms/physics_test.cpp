// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solver's physics through the program, on tiny clouds whose answer is known: what is typed arrives and is in the
// files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "pipelines/report/run_data.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/solution.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/phantoms/program.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/hold_bottom.hpp"

namespace brainshift::physics_test {

constexpr double side = 20;  // mm

class Physics : public testing::Test {
 protected:
  static void SetUpTestSuite() { scratch = std::make_unique<ScratchFolder>(); }
  static void TearDownTestSuite() { scratch.reset(); }

  static std::string at(const std::string& name) { return (*scratch / name).string(); }

  static void write_problem(const solve::Model& model) {
    solve::write_nodes(at("nodes.vtu"), model.cloud, model.conditions);
    write_background_cells(at("cells.vtu"), model.cells);
  }
  /// Runs the solver on the problem written last.
  static void solve(const std::string& options) {
    const ProgramResult result = run_shell("brainshift solve --quiet --nodes " + at("nodes.vtu") + " --cells " +
                                           at("cells.vtu") + " --out " + at("out") + " " + options);
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static auto history() { return read_table(at("out/history.csv")); }
  static nlohmann::json measures() {
    return nlohmann::json::parse(bytes_of(at("out/stage.json")))["entry"]["measures"];
  }

  /// A box that stands on nodes that do not move.
  static solve::Model standing_box(int cells_a_side = 4) {
    solve::Model model;
    model.cloud = test::irregular_box(cells_a_side + 1, side);
    model.cells = test::box_cells(cells_a_side, side);
    model.conditions = test::all_free(model.cloud);
    solve::hold_bottom(model);
    return model;
  }

  static std::unique_ptr<ScratchFolder> scratch;
};
std::unique_ptr<ScratchFolder> Physics::scratch;

/// A rectangle pulled along x by one per cent, free across.
solve::Model pulled_rectangle() {
  solve::Model model;
  model.cloud = test::irregular_rectangle(9, 5, 2 * side, side);
  model.cells = test::rectangle_cells(8, 4, 2 * side, side);
  model.conditions = test::all_free(model.cloud);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double x = model.cloud.positions(a, 0);
    if (x < 1e-6 || x > 2 * side - 1e-6) {
      model.conditions.displacement(a, 0) = 0.01 * x;
    }
  }
  model.conditions.displacement(0, 1) = 0;
  return model;
}

TEST_F(Physics, PlaneStressPullsWithYoungsModulusAndPlaneStrainHarder) {
  write_problem(pulled_rectangle());
  const std::string material =
      "--material 1:law=linear_elastic,youngs_modulus=1000,poisson_ratio=0.3 --tolerance 1e-5 ";
  // Pa mm² = µN: E ε H on one millimetre of thickness.
  const double force = 1000 * 0.01 * side * 1e-6;
  solve(material + "--plane stress --integration consistent");
  EXPECT_NEAR(history().back().at("reaction_x_N"), force, 0.003 * force);
  EXPECT_GT(measures()["consistency_iterations"], 0);
  solve(material + "--plane strain --integration consistent");
  EXPECT_NEAR(history().back().at("reaction_x_N"), force / (1 - 0.3 * 0.3), 0.003 * force);
}

TEST_F(Physics, TrianglesTakeThreePoints) {
  solve::Model model = pulled_rectangle();
  model.cells = test::rectangle_triangles(model.cloud, 9, 5);
  write_problem(model);
  solve("--material 1:1000,0.3 --plane strain --points-per-cell 3 --tolerance 1e-4");
  const auto run = nlohmann::json::parse(bytes_of(at("out/stage.json")))["entry"];
  EXPECT_EQ(run["sizes"]["integration_points"], 3 * 64);
}

TEST_F(Physics, ABoxStandsWithTheWeightAndTheForcesThatItCarries) {
  solve::Model model = standing_box();
  model.conditions.force = Points::Zero(model.cloud.positions.rows(), 3);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > side - 1e-6) {
      model.conditions.force.row(a) << 4e-4, 0, 1e-4;
    }
  }
  write_problem(model);
  solve("--material 1:30000,0.3,1200 --gravity 0,0,-9.81 --tolerance 1e-5");
  const double weight = 1200 * side * side * side * 1e-9 * 9.81;  // N
  const Eigen::RowVector3d carried = model.conditions.force.colwise().sum() - Eigen::RowVector3d(0, 0, weight);
  const Eigen::RowVector3d reaction = read_solution(at("out/solution.vtu")).reaction_force.colwise().sum();
  EXPECT_LE((reaction + carried).norm(), 1e-3 * weight) << reaction << " holds " << carried;
  EXPECT_LT(read_solution(at("out/solution.vtu")).displacement.col(2).minCoeff(), -0.01);
}

TEST_F(Physics, AResectionLeavesACavityThatSinksUnlessPressureHoldsIt) {
  constexpr int cells_a_side = 8;
  solve::Model model = standing_box(cells_a_side);
  BackgroundCells& cells = model.cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Vector3d low = cells.vertices.row(cells.connectivity[8 * i]);
    const Eigen::Vector3d high = cells.vertices.row(cells.connectivity[8 * i + 6]);
    cells.label[i] = ((low + high).array() / 2 - side / 2).abs().maxCoeff() < side / 4 ? 2 : 1;
  }
  write_problem(model);
  const auto sinking_of_top = [&](const std::string& options) {
    solve("--material 1:10000,0.4 --material 2:10000,0.4 --gravity 0,0,-9.81 --tolerance 1e-3 " + options);
    const Solution solution = read_solution(at("out/solution.vtu"));
    return -(solution.positions.col(2).array() > side - 1e-6).select(solution.displacement.col(2), 0).sum();
  };
  const double full = sinking_of_top("");
  EXPECT_FALSE(measures().contains("resection"));
  const double emptied = sinking_of_top("--resection 2");
  EXPECT_NEAR(measures()["resection"]["removed_volume_mm3"], side * side * side / 8, 1e-6);
  EXPECT_EQ(read_solution(at("out/solution.vtu")).positions.rows(),
            model.cloud.positions.rows() - static_cast<int>(measures()["resection"]["removed_nodes"]));
  const double pressed = sinking_of_top("--resection 2 --resection-pressure 100");
  EXPECT_GT(emptied, 1.1 * full);
  EXPECT_LT(pressed, emptied - 0.1 * full);
}

/// What brain_viscoelastic leaves of the shear stress t s after a pull began that took 0.1 s and is held.
double left_at(double t) {
  constexpr double pull = 0.1;
  double left = 1;
  for (const auto& [share, time] : {std::pair(0.450, 0.50), std::pair(0.365, 50.0)}) {
    left -= share * (1 - time / pull * (std::exp(-(t - pull) / time) - std::exp(-t / time)));
  }
  return left;
}

TEST_F(Physics, AViscoelasticBoxRelaxesInTime) {
  solve::Model model = standing_box();
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > side - 1e-6) {
      model.conditions.displacement.row(a) << 0, 0, -0.05 * side;
    }
  }
  write_problem(model);
  write_text(at("curve.csv"), "# pressed at once, then held\ntime,factor\n0,0\n0.1,1\n1,1\n");
  solve("--material 1:brain_viscoelastic --dynamics transient --curve " + at("curve.csv") +
        " --curve-join straight --damping 50 --snapshot-every 500");
  const auto rows = history();
  EXPECT_NEAR(rows.back().at("time"), 1, 1e-3) << "a step before the end";
  EXPECT_GT(rows.back().at("dissipated_energy_mJ"), 0);
  constexpr double calm = 0.3;  // s; before, the box still swings by a hundredth of its reaction and more
  const auto pressed = std::ranges::find_if(rows, [](const auto& row) { return row.at("time") >= calm; });
  ASSERT_NE(pressed, rows.end());
  EXPECT_LT(pressed->at("reaction_z_N"), 0);
  EXPECT_NEAR(rows.back().at("reaction_z_N") / pressed->at("reaction_z_N"), left_at(1) / left_at(pressed->at("time")),
              0.02);
  EXPECT_FALSE(measures().contains("error_bound_mm"));
  EXPECT_TRUE(std::filesystem::exists(at("out/steps.pvd")));
}

TEST_F(Physics, MaterialsMeanTheSameHoweverTheyAreTyped) {
  solve::Model model = standing_box();
  model.conditions.displacement.bottomRows<1>() << 0, 0, 1;
  write_problem(model);
  const auto solution_of = [&](const std::string& material) {
    solve("--tolerance 0.01 --material " + material);
    return bytes_of(at("out/solution.vtu"));
  };
  EXPECT_EQ(solution_of("1:3000,0.49,1000"), solution_of("1:brain"));
  EXPECT_EQ(solution_of("1:brain"), solution_of("1:poisson_ratio=0.49,youngs_modulus=3000,law=neo_hookean"));
  EXPECT_EQ(solution_of("1:brain_ogden"), solution_of("1:law=ogden,ogden=842,-4.7"));
  EXPECT_EQ(solution_of("1:brain_viscoelastic"),
            solution_of("'1:law=ogden,ogden=842,-4.7,prony=0.450,0.50; 0.365,50,poisson_ratio=0.49'"));
  EXPECT_NE(solution_of("1:brain_ogden"), solution_of("1:brain_ogden,poisson_ratio=0.45"));
}

}  // namespace brainshift::physics_test
