// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/run_data.hpp"

#include <algorithm>
#include <fstream>
#include <future>
#include <stdexcept>

#include "pipelines/checksum/sha256.hpp"
#include "register/files/register_fields.hpp"
#include "segmentation/files/bytes_of_file.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/options/values.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::pipelines {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* outdated = "outdated";  // made of other options or files than the stages before it

json read_record(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw std::invalid_argument("there is no " + file.string() + ": give the folder of a finished run");
  }
  json record = json::parse(stream);
  if (record.contains("states")) {
    throw std::invalid_argument(file.parent_path().string() +
                                ": the folder of a sequence; give that of one of its states, states/NAME in it");
  }
  if (record.contains("stages")) {
    for (json& entry : record.at("stages")) {
      if (entry.value("status", "") == outdated) {
        entry = {{"status", outdated}};
      }
    }
  }
  return record;
}

// As it was when the run was made; else why there is none.
std::optional<ScalarImage> read_t1(const json& record, std::string& fault) {
  for (const auto& input : record.value("inputs", json::array())) {
    if (input.value("role", "") == "image.t1") {
      const fs::path file = input.value("path", "");
      const bool there = fs::exists(file);
      if (there && input.value("sha256", "") == sha256_of_file(file)) {
        return read_image(file);
      }
      fault = "The image of this run, " + file.string() + (there ? ", has changed since" : ", is no longer there") +
              ": the slices show the brain's outline alone.";
      return std::nullopt;
    }
  }
  fault = "This run had no image to warp: the slices show the brain's outline alone.";
  return std::nullopt;
}

template <class Read>
auto read_if_there(const fs::path& file, const Read& read) {
  using Content = decltype(read(file));
  return !file.empty() && fs::exists(file) ? std::optional<Content>(read(file)) : std::nullopt;
}

}  // namespace

RunData read_run(const fs::path& run_folder) {
  RunData run{.record = read_record(run_folder / "run.json"),
              .t1 = {},
              .warped = {},
              .forward = {},
              .brain = {},
              .solution = {},
              .history = {}};
  const json stages = run.record.value("stages", json::object());
  const auto made = [&](const fs::path& file) {  // by a stage; empty where that is outdated
    const json entry = stages.value(file.begin()->string(), json::object());
    return entry.value("status", "") == outdated ? fs::path() : run_folder / file;
  };
  const auto image = [](const fs::path& file) { return read_image(file); };
  run.t1 = read_t1(run.record, run.no_image);
  // The field takes as long to read as all the others together.
  auto forward = std::async(std::launch::async, [&] {
    return read_if_there(made("register/preop_to_intraop.nii.gz"),
                         [](const fs::path& file) { return read_vector_image(file); });
  });
  run.warped = read_if_there(made("register/warped.nii.gz"), image);
  const auto label_map = [](const fs::path& file) { return read_label_map(file); };
  run.labels = read_if_there(made("segment/labels.nii.gz"), label_map);
  run.closed = read_if_there(made("segment/closed.nii.gz"), label_map);
  run.brain = read_if_there(made("segment/brain.vtp"), [](const fs::path& file) { return read_surface(file); });
  run.solution = read_if_there(made("solve/solution.vtu"), [](const fs::path& file) { return read_solution(file); });
  run.septum = read_if_there(made("solve/septum.vtp"), [](const fs::path& file) { return read_surface(file); });
  run.history = bytes_of_file(made("solve/history.csv"));
  run.load = bytes_of_file(made("solve/load.csv"));
  run.uncertainty = bytes_of_file(made("solve/uncertainty.csv"));
  if (const fs::path file = made("solve/uncertainty.vtu"); run.solution && fs::exists(file)) {
    run.deviation = registration::read_deviations(file);
  }
  run.warped_labels = read_if_there(made("register/warped_labels.nii.gz"), label_map);
  run.jacobian = read_if_there(made("register/jacobian.nii.gz"), image);
  run.forward = forward.get();
  if (run.t1 && !run.warped) {
    run.no_image = "No image was warped: of the stage register there is no result of this run.";
  }
  return run;
}

solve::Dynamics dynamics_of(const json& record) {
  const json::json_pointer place("/options/solve/dynamics");
  return record.contains(place) && record.at(place) == "transient" ? solve::Dynamics::transient
                                                                   : solve::Dynamics::relaxation;
}

std::vector<std::uint16_t> resected_labels(const json& record) {
  const json::json_pointer labels("/options/resection/labels");
  const std::string text = record.contains(labels) ? record.at(labels).get<std::string>() : "";
  return read_numbers<std::uint16_t>(text).value_or(std::vector<std::uint16_t>());
}

Points loaded_positions(const Solution& solution) {
  Points loaded(solution.positions.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < solution.reaction_force.rows(); ++i) {
    if (solution.reaction_force.row(i).squaredNorm() > 0) {
      loaded.row(count++) = solution.positions.row(i);
    }
  }
  return loaded.topRows(count);
}

}  // namespace brainshift::pipelines
