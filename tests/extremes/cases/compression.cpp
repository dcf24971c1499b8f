// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cylinder with bonded faces to a fifth and a tenth of its height, and a cube whose sides are free. Its uniform state
// is an answer only above 56 % of its height: below, free faces of soft matter fold into creases (Hong, Zhao & Suo
// 2009), which store less energy.
#include <cmath>

#include "tests/extremes/block.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/verification/cases/cylinder_model.hpp"

namespace brainshift::extremes::compression_cases {

namespace {

constexpr double side = 60;

Row cube(double to, int n) {
  constexpr double crease = 0.56;
  const Block block{Eigen::Vector3d::Constant(side), to};
  solve::SolveOptions options;
  options.load_steps = 2000;
  const Ending ending = run(block.model(test::irregular_box(n, side), test::box_cells(n - 1, side)), options);
  const std::string name = "cube to " + std::to_string(std::lround(100 * to)) + " % of its height, sides free";
  if (to > crease) {
    return judge(name, Must::answer, ending, block.errors(ending.result, 0.1, 0.1), on_paper);
  }
  const auto& history = ending.result.history;
  const double energy = history.empty() ? std::nan("") : history.back().strain_energy;
  return judge(name, Must::answer_or_stop, ending,
               {{"energy, of that of the uniform state, which creases", 100 * energy / block.energy(), 100, "%"}},
               on_paper);
}

/// Work and what became of it at full load, of the work there.
double energy_error(const std::vector<solve::HistoryRow>& history) {
  if (history.empty()) {
    return std::nan("");
  }
  const solve::HistoryRow& last = history.back();
  return 100 * std::abs(1 - (last.strain_energy + last.kinetic_energy + last.dissipated_energy) / last.external_work);
}

Row cylinder(double to, double least_distance) {
  constexpr double height = 100;
  solve::Model model = verification::cylinder_model(least_distance, 2, 0.49, {0, 0, (to - 1) * height});
  model.curve = solve::LoadCurve({0, 3}, {0, 1}, solve::LoadCurve::Join::smooth);
  solve::SolveOptions options;
  options.dynamics = solve::Dynamics::transient;
  options.damping = 2;
  options.max_steps = 2000000;
  const Ending ending = run(model, options);
  return judge("cylinder to " + std::to_string(std::lround(100 * to)) + " % of its height, faces bonded, in 3 s",
               Must::answer_or_stop, ending,
               {{"work and what became of it differ by", energy_error(ending.result.history), 2, "%"}},
               std::to_string(model.cloud.size()) + " nodes; balance of energies");
}

}  // namespace

std::vector<Row> compression(bool small) {
  const int n = small ? 5 : 7;
  const double distance = small ? 20 : 13;
  std::vector<Row> rows = {cube(0.6, n), cube(0.5, n), cube(0.2, n), cube(0.1, n), cylinder(0.2, distance)};
  if (!small) {
    rows.push_back(cylinder(0.1, distance));  // ends without an answer after as long as all others together
  }
  return rows;
}

}  // namespace brainshift::extremes::compression_cases
