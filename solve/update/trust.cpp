// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "solve/update/kept_run.hpp"

namespace brainshift::solve {

namespace {

constexpr std::array tried_changes = {6.0, 2.0};  // mm: large, and usual between two measurements
constexpr double share_of_bound = 0.8;            // that an error of a trial may reach: other loads may be farther off
constexpr double much_closer = 0.1;               // of the tolerance: what it is held against

/// Every load times a factor, then moved.
Conditions changed(Conditions load, double factor, const Eigen::RowVector3d& shift) {
  const auto change = [&](Points& displacement) { displacement = (factor * displacement).rowwise() + shift; };
  change(load.displacement);
  if (load.measured) {
    change(load.measured->cortex_displacement);
    change(load.measured->inner_displacement);
  }
  return load;
}

double largest(const Points& displacement) {
  return displacement.array().isNaN().select(0, displacement.array()).matrix().rowwise().norm().maxCoeff();
}

/// More and less of the load, and all of it moved to the side.
std::vector<Conditions> loads_that_differ(const Conditions& load, double by) {
  const Points given = load.displacement.array().isNaN().select(0, load.displacement.array());
  const Eigen::RowVector3d sum = given.colwise().sum();
  Eigen::Index across = 0;
  sum.cwiseAbs().minCoeff(&across);
  std::vector<Conditions> loads = {changed(load, 1, by * Eigen::RowVector3d::Unit(across))};
  if (const double most = largest(load.displacement); most > 0) {
    for (const double factor : {1 + by / most, 1 - by / most}) {
      loads.push_back(changed(load, factor, Eigen::RowVector3d::Zero()));
    }
  }
  return loads;
}

/// Whether the answer is no farther from rest than a good part of its bound.
bool is_answered_honestly(const KeptRun& kept, const Conditions& load, const Progress& progress) {
  const auto answered = [&](double trusted, double tolerance) {
    KeptRun run = kept;
    run.trusted = trusted;
    run.options.tolerance *= tolerance;
    return update(run, load, progress);
  };
  const SolveResult answer = answered(std::numeric_limits<double>::infinity(), 1);
  if (!answer.failure.empty()) {
    return false;
  }
  const SolveResult close = answered(0, much_closer);
  const double off = largest(answer.solution.displacement - close.solution.displacement);
  return close.failure.empty() && off <= share_of_bound * answer.measures.error_bound;
}

}  // namespace

double trusted_change(const KeptRun& kept, const Conditions& load, const Progress& progress) {
  for (const double by : tried_changes) {
    const std::vector<Conditions> loads = loads_that_differ(load, by);
    if (std::ranges::all_of(loads, [&](const Conditions& l) { return is_answered_honestly(kept, l, progress); })) {
      return by;
    }
  }
  return 0;
}

}  // namespace brainshift::solve
