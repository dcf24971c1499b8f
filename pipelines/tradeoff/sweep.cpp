// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/sweep.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "pipelines/checksum/sha256.hpp"
#include "pipelines/runner/json_text.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/run.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/describe_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "pipelines/tradeoff/own_stages.hpp"
#include "segmentation/files/make_folder.hpp"
#include "segmentation/options/values.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

using nlohmann::ordered_json;

/// What a point was made from: the scene with its settings, the files' contents, the version.
std::string stamp_of(const Scene& scene, const std::string& reference) {
  ordered_json text = {
      {"version", BRAINSHIFT_VERSION}, {"reference", reference}, {"options", effective_options(scene)}};
  for (const InputFile& file : scene_files(scene)) {
    text["files"][file.role] = sha256_of_file(file.path);
  }
  return sha256_of_text(json_text(text));
}

ordered_json as_json(const TradeoffPoint& p, const std::string& stamp) {
  return {{"stamp", stamp},
          {"failure", p.failure},
          {"nodes", p.nodes},
          {"points", p.points},
          {"steps", p.steps},
          {"solve_seconds", p.solve_seconds},
          {"whole_seconds", p.whole_seconds},
          {"largest_mm", p.error.largest},
          {"percentile_95_mm", p.error.percentile_95},
          {"mean_mm", p.error.mean},
          {"landmarks_mm", p.landmark_error}};
}

/// False when the file is not there, unreadable, or of something else.
bool read_point(const fs::path& file, const std::string& stamp, TradeoffPoint& p) {
  std::ifstream stream(file);
  const ordered_json json = ordered_json::parse(stream, nullptr, false);
  if (!json.is_object() || json.value("stamp", "") != stamp) {
    return false;
  }
  p.failure = json.at("failure");
  p.nodes = json.at("nodes");
  p.points = json.at("points");
  p.steps = json.at("steps");
  p.solve_seconds = json.at("solve_seconds");
  p.whole_seconds = json.at("whole_seconds");
  p.error = {json.at("largest_mm"), json.at("percentile_95_mm"), json.at("mean_mm")};
  const ordered_json& landmarks = json.at("landmarks_mm");  // JSON has no NaN
  p.landmark_error = landmarks.is_null() ? std::numeric_limits<double>::quiet_NaN() : landmarks.get<double>();
  return true;
}

class Sweeper {
 public:
  Sweeper(fs::path scene, std::vector<std::string> overrides, fs::path out, Interruption& interruption)
      : scene_(std::move(scene)), overrides_(std::move(overrides)), out_(std::move(out)), interruption_(interruption) {}

  /// The scene itself, with the lists of what is tried.
  Scene own_scene() const {
    Scene scene = parse_scene(scene_, overrides_);
    check_scene(scene);
    if (!scene.states.empty()) {
      throw std::invalid_argument(place(scene.source, "sequence") +
                                  ": settings are varied of one state; leave <sequence> out");
    }
    need_own_stages(scene, "whose settings cannot be varied");
    return scene;
  }

  void solve_reference(const Choice& choice) {
    const Scene scene = with(choice);
    reference_stamp_ = stamp_of(scene, "");
    const RunOutcome outcome = run(scene, {out_ / "reference", StageId::solve, false}, interruption_);
    if (!outcome.failure.empty()) {
      throw std::runtime_error("the reference (" + describe(choice) + ") is " + outcome.failure);
    }
    reference_ = read_solution(out_ / "reference" / "solve" / "solution.vtu");
    if (scene.landmarks) {
      landmarks_ = solve::read_markup_positions(*scene.landmarks);
      at_landmarks_ = solve::displacement_at(reference_, landmarks_);
    }
  }

  /// Seconds of register and report, which the settings leave alone.
  void time_images(const Scene& scene) {
    if (!is_active(StageId::registration, scene)) {
      return;
    }
    const RunOutcome outcome = run(scene, {out_ / "scene", StageId::report, false}, interruption_);
    if (!outcome.failure.empty()) {
      throw std::runtime_error("the scene with its own settings is " + outcome.failure);
    }
    for (const char* stage : {"register", "report"}) {
      image_seconds_ += outcome.record["stages"][stage]["seconds"].get<double>();
    }
  }

  TradeoffPoint measure(const Choice& choice) {
    TradeoffPoint point;
    point.choice = choice;
    const fs::path file = out_ / "points" / (name_of(choice) + ".json");
    const Scene scene = with(choice);
    const std::string stamp = stamp_of(scene, reference_stamp_);
    if (!read_point(file, stamp, point)) {
      try {
        solve(scene, point);
      } catch (const std::invalid_argument& error) {
        point.failure = error.what();  // too coarse a cloud, no support for the basis; or what may pass: not kept
        return point;
      }
      write_whole(file, json_text(as_json(point, stamp)));
    }
    return point;
  }

 private:
  Scene with(const Choice& choice) const {
    std::vector<std::string> all = overrides_;
    for (const std::string& text : overrides_of(choice)) {
      all.push_back(text);
    }
    Scene scene = parse_scene(scene_, all);
    scene.tradeoff.reset();
    scene.uncertainty.reset();  // its samples are no cost of the settings
    return scene;
  }

  void solve(const Scene& scene, TradeoffPoint& point) {
    const RunOutcome outcome = run(scene, {out_ / "run", StageId::solve, false}, interruption_);
    point.failure = outcome.failure;
    if (!point.failure.empty()) {
      return;
    }
    const ordered_json& stages = outcome.record["stages"];
    const ordered_json& sizes = stages["solve"]["sizes"];
    point.nodes = sizes["nodes"];
    point.points = sizes["integration_points"];
    point.steps = sizes["steps"];
    point.solve_seconds = stages["solve"]["seconds"];
    point.whole_seconds = image_seconds_ + point.solve_seconds + stages["segment"]["seconds"].get<double>() +
                          stages["discretise"]["seconds"].get<double>();
    const Solution solution = read_solution(out_ / "run" / "solve" / "solution.vtu");
    point.error = solve::field_difference(reference_, solution);
    point.landmark_error = std::numeric_limits<double>::quiet_NaN();
    if (landmarks_.rows() > 0) {
      point.landmark_error =
          solve::field_difference(at_landmarks_, solve::displacement_at(solution, landmarks_)).largest;
    }
  }

  fs::path scene_;
  std::vector<std::string> overrides_;
  fs::path out_;
  Interruption& interruption_;
  Solution reference_;
  std::string reference_stamp_;
  Points landmarks_ = Points(0, 3), at_landmarks_ = Points(0, 3);
  double image_seconds_ = 0;
};

void check_lists(const Scene& scene, const TradeoffLists& lists) {
  const std::vector<double> nodes = read_numbers<double>(lists.nodes).value();
  const double most = *std::max_element(nodes.begin(), nodes.end());
  if (lists.reference_nodes < 2 * most) {
    throw std::invalid_argument(place(scene.source, "tradeoff.reference_nodes") + ": the reference has " +
                                write_number(lists.reference_nodes) +
                                " nodes, but must have at least twice as many as any choice (" + write_number(most) +
                                ") to tell their errors from its own");
  }
}

}  // namespace

Sweep sweep(const fs::path& scene_file, const std::vector<std::string>& overrides, const fs::path& out,
            Interruption& interruption, const SweepObserver& observer) {
  Sweeper sweeper(scene_file, overrides, place_of(out), interruption);
  Scene scene = sweeper.own_scene();
  const TradeoffLists lists = scene.tradeoff.value_or(TradeoffLists{});
  check_lists(scene, lists);
  scene.tradeoff.reset();
  make_folder(out / "points");
  const std::vector<Choice> choices = all_choices(lists);
  Sweep result{reference_choice(lists), {}};
  sweeper.solve_reference(result.reference);
  sweeper.time_images(scene);
  for (const Choice& choice : choices) {
    result.points.push_back(sweeper.measure(choice));
    observer(result.points.size(), choices.size(), result.points.back());
  }
  return result;
}

}  // namespace brainshift::pipelines
