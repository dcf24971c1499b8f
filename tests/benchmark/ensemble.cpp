// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a model costs to solve with one set of constants, and with sixteen that are stepped together.
//
//   ensemble SCENE RUN one|COUNT [thinned]     (prints seconds, processor seconds and the most bytes that were held)
//   ensemble SCENE RUN check                   (how far the sixteen lie from themselves solved alone, mm)
//
// RUN is a folder of a run of the scene. thinned: on the cloud that uncertainty's samples are solved on.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "solve/ensemble/each.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/together.hpp"
#include "solve/run/whole_body.hpp"
#include "solve/uncertainty/draw.hpp"
#include "tests/benchmark/problems.hpp"

namespace {

using namespace brainshift;
using namespace brainshift::solve;
using bench::Problem;
using Displacements = std::vector<std::optional<Points>>;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_seconds() {
  rusage used;
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Of the process, since it began to solve.
double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) {
      return std::atof(line.c_str() + 6) / 1024;
    }
  }
  return 0;
}

std::vector<Constants> drawn(const Problem& problem, int count) {
  std::vector<Constants> constants;
  for (int sample = 1; sample <= count; ++sample) {
    constants.push_back(drawn_constants(problem.model, {}, sample));
  }
  return constants;
}

std::optional<Points> alone(const Problem& problem, const Constants& constants, bool thinned) {
  const Model model = with_constants(problem.model, constants);
  if (thinned) {
    return coarse_displacement(model, completed(problem.options, model), {});
  }
  SolveResult result = solve_whole_body(model, problem.options, {});
  return result.failure.empty() ? std::optional(std::move(result.solution.displacement)) : std::nullopt;
}

Displacements together(const Problem& problem, const std::vector<Constants>& constants, bool thinned) {
  return thinned ? coarse_displacements(problem.model, completed(problem.options, problem.model), constants, {})
                 : whole_displacements(problem.model, problem.options, constants, {});
}

void check(const Problem& problem) {
  const std::vector<Constants> constants = drawn(problem, static_cast<int>(members));
  const Displacements all = together(problem, constants, true);
  double largest = 0, spread = 0;
  for (std::size_t m = 0; m < constants.size(); ++m) {
    const std::optional<Points> expected = alone(problem, constants[m], true);
    if (!expected || !all[m]) {
      std::printf("sample %zu: alone %s, together %s\n", m + 1, expected ? "solved" : "not", all[m] ? "solved" : "not");
      continue;
    }
    largest = std::max(largest, (*all[m] - *expected).rowwise().norm().maxCoeff());
    spread = std::max(spread, (*all[m] - *all[0]).rowwise().norm().maxCoeff());
  }
  std::printf("largest difference %.3g mm, of samples that differ by %.3g mm\n", largest, spread);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: ensemble SCENE RUN one|COUNT|check [thinned]\n", stderr);
    return 2;
  }
  const Problem problem = bench::problem_of_run(argv[1], argv[2]);
  const std::string what = argv[3];
  const bool thinned = argc > 4;
  if (what == "check") {
    check(problem);
    return 0;
  }
  std::ofstream("/proc/self/clear_refs") << "5";
  const double start = seconds_now(), used = processor_seconds();
  std::size_t solved = 0;
  if (what == "one") {
    solved = alone(problem, drawn(problem, 1)[0], thinned) ? 1 : 0;
  } else {
    for (const auto& displacement : together(problem, drawn(problem, std::atoi(argv[3])), thinned)) {
      solved += displacement ? 1 : 0;
    }
  }
  std::printf("%s: %zu solved, %.2f s, %.2f s of processor, at most %.0f MB\n", what.c_str(), solved,
              seconds_now() - start, processor_seconds() - used, peak_megabytes());
  return 0;
}
