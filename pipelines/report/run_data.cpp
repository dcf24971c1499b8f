// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/run_data.hpp"

#include <algorithm>
#include <fstream>
#include <future>
#include <iterator>
#include <stdexcept>

#include "register/files/register_fields.hpp"
#include "segmentation/files/surface_file.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::pipelines {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read_record(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw std::invalid_argument("there is no " + file.string() + ": give the folder of a finished run");
  }
  try {
    json record = json::parse(stream);
    if (record.contains("states")) {
      throw std::invalid_argument(file.parent_path().string() +
                                  ": the folder of a sequence; give that of one of its states, states/NAME in it");
    }
    return record;
  } catch (const json::exception& fault) {
    throw std::invalid_argument(file.string() + " is no run record (" + fault.what() + "): run the scene again");
  }
}

// The file that came in for a role; empty where the run had none.
fs::path input_path(const json& record, const std::string& role) {
  for (const auto& input : record.value("inputs", json::array())) {
    if (input.value("role", "") == role) {
      return input.value("path", "");
    }
  }
  return {};
}

template <class Read>
auto read_if_there(const fs::path& file, const Read& read) {
  using Content = decltype(read(file));
  return !file.empty() && fs::exists(file) ? std::optional<Content>(read(file)) : std::nullopt;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
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
  const auto image = [](const fs::path& file) { return read_image(file); };
  run.t1 = read_if_there(input_path(run.record, "image.t1"), image);
  // The field takes as long to read as all the others together.
  auto forward = std::async(std::launch::async, [&] {
    return read_if_there(run_folder / "register/preop_to_intraop.nii.gz",
                         [](const fs::path& file) { return read_vector_image(file); });
  });
  run.warped = read_if_there(run_folder / "register/warped.nii.gz", image);
  const auto label_map = [](const fs::path& file) { return read_label_map(file); };
  run.labels = read_if_there(run_folder / "segment/labels.nii.gz", label_map);
  run.closed = read_if_there(run_folder / "segment/closed.nii.gz", label_map);
  run.brain = read_if_there(run_folder / "segment/brain.vtp", [](const fs::path& file) { return read_surface(file); });
  run.solution =
      read_if_there(run_folder / "solve/solution.vtu", [](const fs::path& file) { return read_solution(file); });
  run.septum = read_if_there(run_folder / "solve/septum.vtp", [](const fs::path& file) { return read_surface(file); });
  run.history = text_of(run_folder / "solve/history.csv");
  run.load = text_of(run_folder / "solve/load.csv");
  run.uncertainty = text_of(run_folder / "solve/uncertainty.csv");
  if (const fs::path file = run_folder / "solve/uncertainty.vtu"; run.solution && fs::exists(file)) {
    run.deviation = registration::read_deviations(file);
  }
  run.warped_labels = read_if_there(run_folder / "register/warped_labels.nii.gz", label_map);
  run.jacobian = read_if_there(run_folder / "register/jacobian.nii.gz", image);
  run.forward = forward.get();
  return run;
}

solve::Dynamics dynamics_of(const json& record) {
  const json::json_pointer place("/options/solve/dynamics");
  return record.contains(place) && record.at(place) == "transient" ? solve::Dynamics::transient
                                                                   : solve::Dynamics::relaxation;
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
