// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time steps about the critical one, and a million of them.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/extremes/row.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/swinging_bar.hpp"

namespace brainshift::extremes::steps_cases {

namespace {

/// The time of the last passage of the bar's end through its place at rest, over the exact one.
double period_ratio(const solve::SolveResult& result, double period) {
  const auto [count, last] = solve::SwingingBar::passages(result.snapshots);
  return count == 6 ? last / (11 * period / 4) : std::nan("");
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
  const solve::SwingingBar bar;
  solve::SolveOptions options = solve::in_time();
  options.points_per_cell = 4;
  options.max_steps = 1;
  const double critical = solve::solve(bar.model, options).measures.critical_step;
  options.max_steps = 100000;
  options.snapshot_every = 1;
  std::vector<Row> rows;
  for (const double share : {0.5, 0.99, 1.05, 2.0}) {
    options.time_step = share * critical;
    const Ending ending = run(bar.model, options);
    std::ostringstream name;
    name << "time step " << share << " of the estimate";
    rows.push_back(judge(name.str(), share < 1 ? Must::answer : Must::refuse, ending,
                         {{"period off by", 100 * std::abs(period_ratio(ending.result, bar.period) - 1), 3, "%"},
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
