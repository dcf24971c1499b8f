// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/whole_body.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solve/cut/resection.hpp"
#include "solve/run/attempt.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/pressed_body.hpp"

namespace brainshift::solve {

namespace {

struct Attempt {
  SolveOptions options;
  std::string what;
};

/// What the body is tried with after this result, in this order: none makes the answer looser.
std::vector<Attempt> further_attempts(const SolveResult& result, const SolveOptions& options) {
  constexpr int slower = 5;
  Attempt doubled{.options = options, .what = "double precision"};
  doubled.options.precision = Precision::double_precision;
  if (result.rounded) {
    return {doubled};
  }
  if (!result.unstable) {
    return {};
  }
  std::vector<Attempt> attempts = {{.options = options, .what = {}}};
  if (result.solution.shape.basis != Basis::linear) {
    attempts.push_back({.options = options, .what = "linear shape functions"});
    attempts.back().options.shape.basis = Basis::linear;
  }
  if (options.precision != Precision::double_precision) {
    attempts.push_back(doubled);
  }
  for (auto& [other, what] : attempts) {
    other.start = Start::rest;
    other.load_steps = std::min(other.load_steps, std::numeric_limits<int>::max() / slower) * slower;
    what = std::to_string(other.load_steps) + " load steps" + (what.empty() ? "" : ", " + what);
  }
  return attempts;
}

/// Above some contrast of stiffness a slower load ends, but with an answer that is several times too stiff (measured:
/// two layers of 1 : 10⁶).
bool may_be_tried_again(const Model& model, const SolveOptions& options) {
  constexpr double most_contrast = 1e5;
  return options.dynamics == Dynamics::relaxation && !model.rupture &&
         stiffness_contrast(model.materials) <= most_contrast;
}

/// Of two that failed: what is only not at rest tells more than what blew up. A standstill in single precision advises
/// to take double, which is then what was taken next.
bool tells_more(const SolveResult& next, const SolveResult& result) {
  return result.rounded || (result.unstable && !next.unstable && !next.rounded);
}

/// The first of the further attempts that ends well, else what tells most. One that runs out of steps leaves half as
/// many to the next. What single precision has come to is where double goes on.
SolveResult try_again(Model model, const SolveOptions& options, const SolveMeasures& known, SolveResult result,
                      const Progress& progress) {
  if (result.rounded) {
    model.last = result.solution;
  }
  int steps = options.max_steps;
  std::string tried;
  for (auto& [other, what] : further_attempts(result, options)) {
    other.max_steps = steps;
    report(progress, 0, "not at rest; once more with " + what);
    SolveResult next = attempt_under_pressure(model, other, known, progress);
    put_first(what, next.measures.took);
    if (next.failure.empty()) {
      return next;
    }
    tried += (tried.empty() ? "; tried in vain with " : ", with ") + what + " (" + std::to_string(next.measures.steps) +
             " steps)";
    steps = next.measures.steps < steps ? steps : std::max(1, steps / 2);
    if (tells_more(next, result)) {
      result = std::move(next);
    }
  }
  result.failure += tried;
  return result;
}

}  // namespace

SolveResult solve_whole_body(const Model& model, const SolveOptions& given, const Progress& progress) {
  const SolveOptions options = completed(given, model);
  SolveMeasures measures;
  std::optional<Resected> resected;
  if (model.resection) {
    resected = resect(model, options);
    measures.resection = resected->measures;
  }
  const Model& solved = resected ? resected->rest : model;
  SolveResult result = attempt_under_pressure(solved, options, measures, progress);
  if (result.failure.empty() || !may_be_tried_again(solved, options)) {
    return result;
  }
  return try_again(solved, options, measures, std::move(result), progress);
}

}  // namespace brainshift::solve
