// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time steps about the critical one, and a million of them.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/extremes/row.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::extremes::steps_cases {

namespace {

constexpr double length = 60, modulus = 3000, density = 1000;

/// A bar that is pulled suddenly along its length and swings through three periods.
solve::Model bar() {
  solve::Model model;
  model.plane = solve::Plane::strain;  // without lateral strain, so as thin as any
  model.cloud = test::irregular_rectangle(31, 4, length, 6);
  model.conditions = test::all_free(model.cloud);
  model.cells = test::rectangle_cells(30, 3, length, 6);
  model.materials[1] = {
      .youngs_modulus = modulus, .poisson_ratio = 0, .density = density, .law = solve::Law::linear_elastic};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 0) < 1e-9) {
      model.conditions.displacement(a, 0) = 0;
    }
  }
  model.gravity = {1, 0, 0};
  const double period = 4 * length / (1000 * std::sqrt(modulus / density));  // 4 L/c, s
  model.curve = solve::LoadCurve({0, 1e-6, 3 * period}, {0, 1, 1}, solve::LoadCurve::Join::straight);
  return model;
}

/// The time of the last passage of the bar's end through its place at rest, over the exact one: there the cosines of
/// all modes vanish.
double period_ratio(const solve::SolveResult& result) {
  const double at_rest = density * length * length / (2 * modulus) * 1e-3;
  constexpr Eigen::Index end = 2 * 31 - 1;
  double time_before = 0, before = -at_rest, passage = 0;
  int passages = 0;
  for (const solve::Snapshot& s : result.snapshots) {
    const double off = s.displacement(end, 0) - at_rest;
    if (off * before < 0) {
      passage = time_before + (s.time - time_before) * before / (before - off);
      ++passages;
    }
    before = off;
    time_before = s.time;
  }
  return passages == 6 ? passage / (11 * bar().curve.duration() / 12) : std::nan("");
}

double energy_error(const std::vector<solve::HistoryRow>& history) {
  double worst = 0, largest = 0;
  for (const solve::HistoryRow& row : history) {
    largest = std::max(largest, std::abs(row.external_work));
    worst = std::max(worst, std::abs(row.external_work - row.strain_energy - row.kinetic_energy));
  }
  return worst / largest;
}

}  // namespace

std::vector<Row> time_step(bool) {
  solve::SolveOptions options = solve::in_time();
  options.points_per_cell = 4;
  options.max_steps = 1;
  const double critical = solve::solve(bar(), options).measures.critical_step;
  options.max_steps = 100000;
  options.snapshot_every = 1;
  std::vector<Row> rows;
  for (const double share : {0.5, 0.99, 1.05, 2.0}) {
    options.time_step = share * critical;
    const Ending ending = run(bar(), options);
    std::ostringstream name;
    name << "time step " << share << " of the estimate";
    rows.push_back(judge(name.str(), share < 1 ? Must::answer : Must::refuse, ending,
                         {{"period off by", 100 * std::abs(period_ratio(ending.result) - 1), 3, "%"},
                          {"energies by", 100 * energy_error(ending.result.history), 1, "%"}},
                         "first longitudinal mode of a bar, on paper", share < 1 ? "" : "above the critical one"));
  }
  return rows;
}

std::vector<Row> free_vibration(bool small) {
  const int wanted = small ? 50000 : 1000000;
  solve::Model model = solve::box_model(test::box_cells(2, solve::model_side), 4);
  solve::hold_bottom(model);
  model.gravity = {2, 1, -1};
  constexpr double pulse = 0.05;  // s
  model.curve = solve::LoadCurve({0, 1}, {0, 0}, solve::LoadCurve::Join::smooth);
  solve::SolveOptions options = solve::in_time();
  options.max_steps = 1;
  options.time_step = 0.8 * solve::solve(model, options).measures.critical_step;
  options.max_steps = wanted + 10;
  model.curve =
      solve::LoadCurve({0, pulse / 2, pulse, wanted * options.time_step}, {0, 1, 0, 0}, solve::LoadCurve::Join::smooth);
  const Ending ending = run(model, options);
  std::vector<double> energy;
  for (const solve::HistoryRow& row : ending.result.history) {
    if (row.time > pulse) {
      energy.push_back(row.strain_energy + row.kinetic_energy);
    }
  }
  const auto mean = [&](std::size_t from, std::size_t to) {
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) {
      sum += energy[i] / static_cast<double>(to - from);
    }
    return sum;
  };
  const std::size_t n = energy.size(), part = n / 20;
  const double start = part > 0 ? mean(0, part) : std::nan("");
  const auto [least, most] = std::minmax_element(energy.begin(), energy.end());
  std::ostringstream name;
  name << "free vibration of " << model.cloud.size() << " nodes, " << ending.result.measures.steps << " steps";
  return {judge(name.str(), Must::answer, ending,
                {{"drift of the energy", 100 * std::abs(mean(n - part, n) / start - 1), 0.1, "%"},
                 {"from least to most", 100 * (*most - *least) / start, 1, "%"}},
                "its energy after the push")};
}

}  // namespace brainshift::extremes::steps_cases
