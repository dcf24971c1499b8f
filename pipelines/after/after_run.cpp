// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/after/after_run.hpp"

#include <sstream>
#include <stdexcept>

#include "pipelines/after/cheaper_models.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "segmentation/files/whole_path.hpp"
#include "segmentation/options/values.hpp"
#include "solve/output/field_difference.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

std::string rounded(double value) {
  std::ostringstream text;
  text.precision(2);
  text << value;
  return text.str();
}

double seconds_of(const solve::SolveResult& result) {
  const solve::SolveMeasures& m = result.measures;
  return m.seconds_coarse + m.seconds_setup + m.seconds_stepping;
}

void check_run(const Scene& scene, const fs::path& run, Interruption& interruption) {
  if (!is_ours(scene, StageId::solve)) {
    throw std::invalid_argument(place(scene.source, "solve.command") +
                                ": the solve stage is another program; what its parts change cannot be told");
  }
  const auto record = read_stage_record(run / "solve");
  if (!record) {
    throw std::invalid_argument(run.string() +
                                ": this is not the folder of a run with a solution (it has no solve/stage.json); give "
                                "the --out of 'brainshift run'");
  }
  InputStates states;
  if (record->stamp != stamp(plan_stage(StageId::solve, scene, run, interruption), states)) {
    throw std::invalid_argument(run.string() +
                                ": its solution is not that of this scene: options, inputs or the "
                                "program have changed since; run the scene again, with the same --set");
  }
  if (!record->failure.empty()) {
    throw std::invalid_argument(run.string() + ": its solve stage failed: " + record->failure);
  }
}

/// What a model changed and saved.
struct Trial {
  double largest = 0, percentile_95 = 0;  ///< of the change, mm
  double saved = 0;                       ///< s
  std::string fault;                      ///< empty, or why there is no solution
};

/// Without a resection, or with another, there are other nodes.
solve::FieldDifference change_of(const Solution& whole, const Solution& other) {
  const bool same = whole.positions.rows() == other.positions.rows() && whole.positions == other.positions;
  return same ? solve::field_difference(whole.displacement, other.displacement) : solve::field_difference(whole, other);
}

Trial tried(const CheaperModel& cheaper, const SolveInput& input, const solve::SolveResult& whole) {
  SolveInput other = input;
  cheaper.make(other.model, other.options);
  Trial trial;
  try {
    const solve::SolveResult result = solve::solve(other.model, other.options);
    const auto change = change_of(whole.solution, result.solution);
    trial = {change.largest, change.percentile_95, seconds_of(whole) - seconds_of(result), result.failure};
  } catch (const std::invalid_argument& error) {
    trial.fault = error.what();
  }
  return trial;
}

std::string verdict(const Trial& trial, bool left_out, double within) {
  std::ostringstream text;
  if (!trial.fault.empty()) {
    text << "needed: else there is no solution (" << trial.fault << ")";
    return text.str();
  }
  const bool none = trial.largest < within;
  const std::string tolerance = write_number(within) + " mm";
  text << (none ? "" : "needed: ") << (left_out ? "leaving it out" : "that") << " changes the answer by at most "
       << rounded(trial.largest) << " mm (95 %: " << rounded(trial.percentile_95) << "), "
       << (none ? "less than " : "not less than ") << "the tolerance of " << tolerance << ", and "
       << (trial.saved > 0 ? "saves " + rounded(trial.saved) : "costs " + rounded(-trial.saved)) << " s";
  text << (none ? (left_out ? ": you can leave it out" : ": you can take it") : "");
  return text.str();
}

}  // namespace

std::string explain_after(const Scene& scene, const fs::path& run, std::optional<double> within,
                          Interruption& interruption, const std::function<void(const std::string&)>& tell) {
  const fs::path folder = whole_path(run);
  check_run(scene, folder, interruption);
  const double limit = within.value_or(scene.solve.tolerance);
  const SolveInput input = read_input(solve_job(scene, folder));
  tell("as it was");
  const solve::SolveResult whole = solve::solve(input.model, input.options);
  if (!whole.failure.empty()) {
    throw std::invalid_argument(run.string() + ": solved once more, the run fails: " + whole.failure);
  }
  std::ostringstream text;
  text << "after the run: " << rounded(seconds_of(whole)) << " s as it was; what each part changes at "
       << whole.measures.nodes << " nodes\n";
  for (const CheaperModel& cheaper : cheaper_models(input.model, input.options, whole.measures.largest_stretch)) {
    text << "  " << cheaper.part << " (" << cheaper.change << "): ";
    if (!cheaper.not_tried.empty()) {
      text << cheaper.not_tried << "\n";
      continue;
    }
    tell(cheaper.part + ": " + cheaper.change);
    text << verdict(tried(cheaper, input, whole), cheaper.change == "left out", limit) << "\n";
  }
  return text.str();
}

}  // namespace brainshift::pipelines
