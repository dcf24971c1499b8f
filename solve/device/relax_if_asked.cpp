// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/relax_if_asked.hpp"

#include <string>
#include <utility>

#include "solve/device/backend.hpp"
#include "solve/device/device_body.hpp"
#include "solve/device/relax_on_device.hpp"
#include "solve/device/where_asked.hpp"
#include "solve/dynamics/relaxation.hpp"

namespace brainshift::solve::device {

SteppingResult go_on(SteppingResult left, const Course& course, SolveOptions options, const Progress& progress) {
  report(progress, 0, "slow; the processor goes on, which makes rigid motions quicker");
  options.max_steps -= left.steps;
  Course rest{.curve = course.curve, .start = std::move(left.parameters), .bound = course.bound, .goes_on = true};
  if (course.settled) {
    rest.settled = std::move(left.settled);
    rest.settled->of_rigid = course.settled->of_rigid;
  }
  SteppingResult result = solve::relax(std::move(left.body), rest, options, progress);
  result.steps += left.steps;
  for (HistoryRow& row : result.history) {
    row.step += left.steps;
  }
  const bool from_there = !result.history.empty() && result.history.front().time >= 1;  // else once more from rest
  if (from_there) {
    result.history.insert(result.history.begin(), left.history.begin(), left.history.end());
  }
  return result;
}

namespace {

/// As a sentence; empty: it can.
std::string why_not_there(const Backend* backend, const Body& body, const Course& course, const SolveOptions& options) {
  if (backend == nullptr) {
    return why_no_gpu();
  }
  if (const std::string of_body = why_not(body); !of_body.empty()) {
    return "a GPU cannot solve this body, which " + of_body;
  }
  if (course.change || options.snapshot_every > 0 || options.imposition == Imposition::simplified) {
    return "a GPU does not cut, keep steps or impose displacements in the simplified form";
  }
  return {};
}

}  // namespace

std::optional<SteppingResult> relax_where_asked(const Backend* backend, const Body& body, const Course& course,
                                                const SolveOptions& options, const Progress& progress,
                                                const std::function<Relaxed(const Backend&)>& relax) {
  const auto why_not = [&] { return why_not_there(backend, body, course, options); };
  return where_asked(options.device, "device", why_not, progress, [&] {
    Relaxed relaxed = relax(*backend);
    return relaxed.slow ? go_on(std::move(relaxed.result), course, options, progress) : std::move(relaxed.result);
  });
}

void leave_motion_to_processor(const SolveOptions& options, const Progress& progress) {
  const auto why_not = [] { return std::string("a GPU does not follow motion in time"); };
  where_asked(options.device, "device", why_not, progress, [] { return true; });
}

std::optional<SteppingResult> relax_if_asked(Body& body, const Course& course, const SolveOptions& options,
                                             bool cautious, const Progress& progress) {
  const Backend* backend = options.device == Device::cpu ? nullptr : gpu();
  return relax_where_asked(backend, body, course, options, progress,
                           [&](const Backend& on) { return relax(on, body, course, options, cautious, progress); });
}

}  // namespace brainshift::solve::device
