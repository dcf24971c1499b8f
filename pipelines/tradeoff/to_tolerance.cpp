// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/to_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "pipelines/runner/artefacts.hpp"
#include "pipelines/runner/own_folder.hpp"
#include "pipelines/runner/peak_memory.hpp"
#include "pipelines/runner/run_record.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "pipelines/tradeoff/own_stages.hpp"
#include "segmentation/files/make_folder.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

constexpr double order = 1.5;
constexpr std::size_t first_nodes = 1000;
constexpr double stop_share = 0.05;   // of the tolerance, left to stepping
constexpr double mb_per_node = 0.04;  // of the solve stage, measured: 33 kB and what the image takes

void check(const Scene& scene, const Tolerance& wanted, const RunOptions& options) {
  const double tolerance = wanted.error;
  if (!(tolerance > 0) || !std::isfinite(tolerance)) {
    throw std::invalid_argument("--tolerance is " + std::to_string(tolerance) + ", but must be a number > 0 (mm)");
  }
  if (wanted.most_nodes.value_or(first_nodes) < first_nodes) {
    throw std::invalid_argument("--max-nodes is " + std::to_string(*wanted.most_nodes) +
                                ", but a run to a tolerance begins with " + std::to_string(first_nodes) + " nodes");
  }
  if (options.until < StageId::solve) {
    throw std::invalid_argument("a run to a tolerance solves: --until must be solve or a later stage");
  }
  if (!scene.states.empty()) {
    throw std::invalid_argument(place(scene.source, "sequence") +
                                ": --tolerance refines one state; leave <sequence> out to find the cloud, then run "
                                "the sequence on it");
  }
  need_own_stages(scene, "which --tolerance cannot refine");
}

/// What the trade-off shows to suit any tolerance: its front consists of these, only nodes and stop differ (README.md).
Scene scene_of_level(const Scene& scene, std::size_t nodes, double tolerance) {
  Scene level = scene;
  level.discretise.spacing.reset();
  level.discretise.nodes = nodes;
  level.solve.points_per_cell.reset();
  level.solve.integration_tolerance = 0;
  level.solve.shape.basis = Basis::linear;
  level.solve.shape.derivatives = Derivatives::full;
  level.solve.precision = solve::Precision::single_precision;
  level.solve.tolerance = stop_share * tolerance;
  return level;
}

/// Also where an artefact of either was edited, which leaves its stamp.
bool is_copied(const fs::path& from, const fs::path& to) {
  const auto record = read_stage_record(from), copy = read_stage_record(to);
  return record && copy && record->stamp == copy->stamp && artefacts_in(from) == artefacts_in(to);
}

void copy_stage(const fs::path& from, const fs::path& to, Interruption& interruption) {
  if (is_copied(from, to)) {
    return;
  }
  refuse_foreign_folder(to);
  StageFolder folder(to, interruption);
  fs::copy(from, folder.path(), fs::copy_options::recursive);
  folder.replace();
}

nlohmann::ordered_json as_json(const Level& level) {
  nlohmann::ordered_json json = {
      {"nodes", level.nodes}, {"mean_spacing_mm", level.spacing}, {"seconds", level.seconds}};
  if (std::isfinite(level.estimate.percentile_95)) {
    json["estimated_error_95_mm"] = level.estimate.percentile_95;
    json["estimated_error_largest_mm"] = level.estimate.largest;
  }
  return json;
}

class Refinement {
 public:
  Refinement(const Scene& scene, double tolerance, const RunOptions& options, Interruption& interruption,
             const RunObserver& observer)
      : scene_(scene), tolerance_(tolerance), options_(options), interruption_(interruption), observer_(observer) {}

  /// Solves one level in its own folder; empty, or why it did not converge.
  std::string solve_level(std::size_t nodes) {
    const fs::path folder = folder_of(nodes);
    make_folder(folder);
    copy_stage(options_.out / "segment", folder / "segment", interruption_);
    const RunOutcome outcome = run(scene_of_level(scene_, nodes, tolerance_), {folder, StageId::solve, options_.force},
                                   interruption_, observer_);
    if (!outcome.failure.empty()) {
      return outcome.failure;
    }
    const auto& stages = outcome.record["stages"];
    constexpr double unknown = std::numeric_limits<double>::infinity();
    Level level{stages["solve"]["sizes"]["nodes"],
                stages["discretise"]["measures"]["mean_spacing_mm"],
                stages["discretise"]["seconds"].get<double>() + stages["solve"]["seconds"].get<double>(),
                {unknown, unknown, unknown}};
    Solution solution = read_solution(folder / "solve" / "solution.vtu");
    if (!levels.empty()) {
      level.estimate = estimated_error(solve::field_difference(solution, solution_),
                                       levels.back().spacing / level.spacing, stop_share * tolerance_);
    }
    solution_ = std::move(solution);
    levels.push_back(level);
    nodes_ = nodes;
    return {};
  }

  /// The last level becomes the run's own.
  RunOutcome finish() {
    for (const char* stage : {"discretise", "solve"}) {
      copy_stage(folder_of(nodes_) / stage, options_.out / stage, interruption_);
    }
    if (levels.size() > 1) {  // of one level alone what its own solve estimates stays
      StageRecord record = *read_stage_record(options_.out / "solve");
      record.entry["measures"]["estimated_error_95_mm"] = levels.back().estimate.percentile_95;
      record.entry["measures"]["estimated_error_largest_mm"] = levels.back().estimate.largest;
      write_stage_record(options_.out / "solve", record);
    }
    RunOptions options = options_;
    options.force = false;
    RunOutcome outcome = run(scene_of_level(scene_, nodes_, tolerance_), options, interruption_, observer_);
    outcome.record["tolerance"] = {{"asked_95_mm", tolerance_}, {"levels", nlohmann::ordered_json::array()}};
    for (const Level& level : levels) {
      outcome.record["tolerance"]["levels"].push_back(as_json(level));
    }
    write_run_record(options_.out, outcome.record, interruption_);
    return outcome;
  }

  std::vector<Level> levels;

 private:
  fs::path folder_of(std::size_t nodes) const { return options_.out / "levels" / std::to_string(nodes); }

  const Scene& scene_;
  double tolerance_;
  const RunOptions& options_;
  Interruption& interruption_;
  const RunObserver& observer_;
  Solution solution_;
  std::size_t nodes_ = 0;  ///< asked for
};

std::string missed_sentence(const Level& reached, double tolerance, const std::string& why) {
  std::ostringstream text;
  text << "the tolerance of " << tolerance << " mm was not reached: with " << reached.nodes
       << " nodes the estimated error is ";
  if (std::isfinite(reached.estimate.percentile_95)) {
    text << reached.estimate.percentile_95 << " mm (95 % of the brain; largest " << reached.estimate.largest << " mm)";
  } else {
    text << "not known, for there is no second solution";
  }
  text << "; " << why;
  return text.str();
}

}  // namespace

solve::FieldDifference estimated_error(const solve::FieldDifference& difference, double ratio, double stop) {
  const double share = 1 / (std::pow(std::max(ratio, 1.1), order) - 1);
  return {share * difference.largest + stop, share * difference.percentile_95 + stop, share * difference.mean + stop};
}

std::size_t next_nodes(const Level& level, double tolerance) {
  const double finer = std::pow(level.estimate.percentile_95 / (0.9 * tolerance), 3 / order);
  return static_cast<std::size_t>(std::clamp(finer, 2.0, 8.0) * static_cast<double>(level.nodes));
}

ToleranceOutcome run_to_tolerance(const Scene& scene, const Tolerance& wanted, const RunOptions& options,
                                  Interruption& interruption, const RunObserver& observer,
                                  const std::function<void(const Level&)>& level_done) {
  const double tolerance = wanted.error;
  check(scene, wanted, options);
  ToleranceOutcome outcome;
  RunOptions segment = options;
  segment.until = StageId::segment;
  run(scene, segment, interruption, observer);
  const std::size_t most_nodes =
      wanted.most_nodes.value_or(static_cast<std::size_t>(available_memory_mb() / mb_per_node));
  Refinement refinement(scene, tolerance, options, interruption, observer);
  std::vector<Level>& levels = refinement.levels;
  std::size_t nodes = first_nodes;
  for (bool enough = false; !enough;) {
    const std::string failure = refinement.solve_level(nodes);
    if (!failure.empty()) {
      if (levels.empty()) {
        outcome.run.failure = failure;
        return outcome;
      }
      outcome.missed = missed_sentence(levels.back(), tolerance, "on a finer cloud the solve is " + failure);
      break;
    }
    if (level_done) {
      level_done(levels.back());
    }
    enough = levels.back().estimate.percentile_95 <= tolerance;
    nodes = levels.size() == 1 ? 4 * first_nodes : next_nodes(levels.back(), tolerance);
    if (!enough && nodes > most_nodes) {
      outcome.missed = missed_sentence(levels.back(), tolerance,
                                       "the next cloud would have " + std::to_string(nodes) + " nodes, but " +
                                           std::to_string(most_nodes) +
                                           (wanted.most_nodes ? " are allowed" : " are what fits the memory"));
      break;
    }
  }
  outcome.run = refinement.finish();
  outcome.levels = levels;
  return outcome;
}

}  // namespace brainshift::pipelines
