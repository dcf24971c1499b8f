// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a model costs to solve with one set of constants, and with sixteen that are stepped together.
//
//   ensemble SCENE RUN one|COUNT [thinned]     (prints seconds, processor seconds and the most bytes that were held)
//   ensemble SCENE RUN check                   (how far the sixteen lie from themselves solved alone, mm)
//   ensemble SCENE RUN device COUNT [thinned]  (so many on the GPU: its parts, and how far from the processor's, mm)
//
// RUN is a folder of a run of the scene. thinned: on the cloud that uncertainty's samples are solved on.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "segmentation/progress/stopwatch.hpp"
#include "solve/body/forces.hpp"
#include "solve/body/lay_out.hpp"
#include "solve/device/each/device_ensemble.hpp"
#include "solve/device/each/relax_together.hpp"
#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/ensemble/each.hpp"
#include "solve/ensemble/relax_together.hpp"
#include "solve/force/largest_eigenvalue.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/completed.hpp"
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

/// A body, and members as coarse_displacements() and whole_displacements() make them, from rest.
struct Loaded {
  Body body;
  std::vector<Member> loads;
  SolveOptions options;
};

Loaded loaded(const Problem& problem, int count, bool thinned) {
  Loaded result{.body = {}, .loads = {}, .options = completed(problem.options, problem.model)};
  Model model = problem.model;
  Prepared prepared;
  if (thinned) {
    CoarseBody coarse = coarse_body(coarse_nodes(model.cloud, model.conditions), model, result.options, {}, true);
    model = std::move(coarse.model);
    prepared = std::move(coarse.prepared);
    result.options = coarse.options;
  } else {
    SolveMeasures measures;
    prepared = prepare(model, result.options, {}, measures, {}, true);
  }
  result.body = std::move(prepared.body);
  for (const Constants& constants : drawn(problem, count)) {
    model = with_constants(std::move(model), constants);
    result.loads.push_back({.laws = laws_with(result.body, model.materials),
                            .external = external_force(model, *prepared.parts, Dynamics::relaxation)});
  }
  return result;
}

/// Of the first members, what each part of their way takes, with its launch, µs.
template <class Scalar>
void time_parts(const device::Backend& backend, const Loaded& of) {
  const Stopwatch setting_up;
  device::DeviceEnsemble<Scalar> on(backend, of.body, true);
  device::RecordOfEach record;
  on.read(record);
  std::printf("  set-up %.1f ms, %.0f MB\n", 1e3 * setting_up.seconds(), 1e-6 * static_cast<double>(on.bytes()));
  const std::span<const Member> some =
      std::span(of.loads).first(std::min<std::size_t>(of.loads.size(), device::most_members));
  device::OrderOfEach order;
  order.who = static_cast<device::Members>((std::uint64_t{1} << some.size()) - 1);
  order.alpha = relaxation_alpha;
  order.mass_margin = mass_margin;
  order.mode_size = small_mode;
  order.iterations = tightness_iterations;
  std::fill_n(order.mass_scale, device::most_members, 1.0);
  std::fill_n(order.halt_below, device::most_members, -1e9);
  std::fill_n(order.beta, device::most_members, critical_beta(1e-3));
  on.set_fractions(std::vector((device::most_steps + 1) * device::most_members, 0.01));
  const auto time = [&](const char* what, int each, const auto& call) {
    call();
    on.read(record);
    constexpr int repeats = 5;
    const Stopwatch watch;
    for (int i = 0; i < repeats; ++i) {
      call();
      on.read(record);
    }
    std::printf("  %s %.1f us\n", what, 1e6 * watch.seconds() / (repeats * each));
  };
  const auto perform = [&](device::TaskOfEach task) { return [&, task] { on.perform(task, order); }; };
  time("load", 1, [&] { on.load(some); });
  time("follow", 1, perform(device::TaskOfEach::follow));
  time("weigh", 1, perform(device::TaskOfEach::weigh));
  std::vector<double> modes(on.values());
  const NodalVectors mode = rough_mode(on.nodes());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    modes[i] = mode[i / device::most_members];
  }
  on.write(modes, on.view().mode_of_body);
  time("force (power iteration)", tightness_iterations, perform(device::TaskOfEach::measure_tightness));
  time("look", 1, perform(device::TaskOfEach::look));
  time("hold", 1, perform(device::TaskOfEach::hold));
  for (const int steps : {1, device::most_steps}) {
    order.steps = steps;
    time(steps == 1 ? "one step" : "a step of twenty", steps, perform(device::TaskOfEach::step));
  }
  std::printf("  conditions %d, touching %d, pieces %d, slots %d\n", on.view().condition[0].count,
              on.view().contact.count, on.view().pieces, on.view().slots);
}

/// Steps of ensembles of so many members.
int steps_of(const std::vector<MemberResult>& results, std::size_t together) {
  int steps = 0, most = 0;
  for (std::size_t m = 0; m < results.size(); ++m) {
    most = std::max(most, results[m].steps);
    if ((m + 1) % together == 0 || m + 1 == results.size()) {
      steps += most;
      most = 0;
    }
  }
  return steps;
}

/// Sixteen of them by the processor, to hold them against.
void compare(const Loaded& of, const LoadCurve& curve, const std::vector<MemberResult>& on_gpu) {
  const std::span<const Member> some = std::span(of.loads).first(std::min(of.loads.size(), members));
  const Stopwatch watch;
  const std::vector<MemberResult> expected = relax_together(of.body, some, curve, of.options, {});
  std::printf("the processor: %zu in %.2f s\n", some.size(), watch.seconds());
  double apart = 0, spread = 0;
  for (std::size_t m = 0; m < some.size(); ++m) {
    if (expected[m].end != on_gpu[m].end || expected[m].steps != on_gpu[m].steps) {
      std::printf("sample %zu: ends as %d after %d steps, on the GPU as %d after %d\n", m + 1,
                  static_cast<int>(expected[m].end), expected[m].steps, static_cast<int>(on_gpu[m].end),
                  on_gpu[m].steps);
    }
    if (expected[m].end == MemberResult::End::rest && on_gpu[m].end == MemberResult::End::rest) {
      apart = std::max(apart, largest_difference(expected[m].parameters, on_gpu[m].parameters));
      spread = std::max(spread, largest_difference(expected[m].parameters, expected[0].parameters));
    }
  }
  std::printf("largest difference %.3g mm, of samples that differ by %.3g mm\n", apart, spread);
}

void time_device(const device::Backend& backend, const Problem& problem, int count, bool thinned) {
  Stopwatch watch;
  const Loaded of = loaded(problem, count, thinned);
  std::printf("%zu nodes, %zu points; prepared, with %d loads, in %.2f s\n", of.body.nodes(), of.body.points.points(),
              count, watch.seconds());
  if (of.body.points.precision() == Precision::single_precision) {
    time_parts<float>(backend, of);
  } else {
    time_parts<double>(backend, of);
  }
  std::vector<MemberResult> results;
  for (int repeat = 0; repeat < 3; ++repeat) {
    watch = {};
    results = device::relax_together(backend, of.body, of.loads, problem.model.curve, of.options, {});
    const double seconds = watch.seconds();
    const auto rest = std::count_if(results.begin(), results.end(),
                                    [](const MemberResult& r) { return r.end == MemberResult::End::rest; });
    const int steps = steps_of(results, device::most_members);
    std::printf("%d loads: %td at rest, %.3f s, %d steps of %d, %.1f us each with all else\n", count, rest, seconds,
                steps, device::most_members, 1e6 * seconds / steps);
  }
  compare(of, problem.model.curve, results);
  SolveOptions options = problem.options;
  for (const Device where : {Device::cuda, Device::cpu}) {
    options.device = where;
    const int these = where == Device::cuda ? count : static_cast<int>(members);
    watch = {};
    together({.model = problem.model, .options = options}, drawn(problem, these), thinned);
    std::printf("from a model to displacements, %s: %d in %.2f s\n", where == Device::cuda ? "GPU" : "processor", these,
                watch.seconds());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: ensemble SCENE RUN one|COUNT|check|device COUNT [thinned]\n", stderr);
    return 2;
  }
  const Problem problem = bench::problem_of_run(argv[1], argv[2]);
  const std::string what = argv[3];
  const bool thinned = std::string(argv[argc - 1]) == "thinned";
  if (what == "check") {
    check(problem);
    return 0;
  }
  if (what == "device" && argc > 4) {
    if (device::gpu() == nullptr) {
      std::fprintf(stderr, "ensemble: %s\n", device::why_no_gpu().c_str());
      return 1;
    }
    time_device(*device::gpu(), problem, std::atoi(argv[4]), thinned);
    return 0;
  }
  std::ofstream("/proc/self/clear_refs") << "5";
  const Stopwatch watch;
  const double used = processor_seconds();
  std::size_t solved = 0;
  if (what == "one") {
    solved = alone(problem, drawn(problem, 1)[0], thinned) ? 1 : 0;
  } else {
    for (const auto& displacement : together(problem, drawn(problem, std::atoi(argv[3])), thinned)) {
      solved += displacement ? 1 : 0;
    }
  }
  std::printf("%s: %zu solved, %.2f s, %.2f s of processor, at most %.0f MB\n", what.c_str(), solved, watch.seconds(),
              processor_seconds() - used, peak_megabytes());
  return 0;
}
