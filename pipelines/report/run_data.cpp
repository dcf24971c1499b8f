// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/run_data.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <future>
#include <map>
#include <stdexcept>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/files/text_lines.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "solve/output/field_difference.hpp"
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
    return json::parse(stream);
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

// Columns that are not known are left out.
void set_column(solve::HistoryRow& row, const std::string& name, double value) {
  static const std::map<std::string, double solve::HistoryRow::*> columns = {
      {"time", &solve::HistoryRow::time},
      {"external_work_mJ", &solve::HistoryRow::external_work},
      {"strain_energy_mJ", &solve::HistoryRow::strain_energy},
      {"kinetic_energy_mJ", &solve::HistoryRow::kinetic_energy},
      {"dissipated_energy_mJ", &solve::HistoryRow::dissipated_energy},
      {"residual", &solve::HistoryRow::residual},
      {"error_bound_mm", &solve::HistoryRow::error_bound}};
  static const std::array<std::string, 3> reactions = {"reaction_x_N", "reaction_y_N", "reaction_z_N"};
  if (const auto column = columns.find(name); column != columns.end()) {
    row.*column->second = value;
  } else if (const auto axis = std::find(reactions.begin(), reactions.end(), name); axis != reactions.end()) {
    row.reaction[axis - reactions.begin()] = value;
  } else if (name == "step") {
    row.step = static_cast<int>(value);
  }
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
  if (fs::exists(run_folder / "solve/history.csv")) {
    run.history = read_history(run_folder / "solve/history.csv");
  }
  run.forward = forward.get();
  return run;
}

solve::Dynamics dynamics_of(const json& record) {
  const json::json_pointer place("/options/solve/dynamics");
  return record.contains(place) && record.at(place) == "transient" ? solve::Dynamics::transient
                                                                   : solve::Dynamics::relaxation;
}

std::vector<solve::HistoryRow> read_history(const fs::path& file) {
  const std::vector<std::string> lines = read_lines(file);
  const std::vector<std::string> names = split_fields(lines[0]);
  for (const char* needed : {"step", "time"}) {
    if (std::find(names.begin(), names.end(), needed) == names.end()) {
      fail_at_line(file, 1, std::string("there is no column '") + needed + "'");
    }
  }
  std::vector<solve::HistoryRow> rows;
  for (std::size_t number = 2; number <= lines.size(); ++number) {
    const std::string& line = lines[number - 1];
    const std::vector<std::string> fields = split_fields(line);
    if (fields.size() != names.size()) {
      fail_at_line(file, number, std::to_string(names.size()) + " numbers expected, found '" + line + "'");
    }
    solve::HistoryRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < fields.size(); ++i) {
      char* end = nullptr;
      const double value = std::strtod(fields[i].c_str(), &end);  // not parse_number(): a row may hold nan and inf
      if (end == fields[i].c_str() || *end != '\0') {
        fail_at_line(file, number, names[i] + " is '" + fields[i] + "', but must be a number");
      }
      set_column(row, names[i], value);
    }
  }
  return rows;
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

Points displacement_at(const Solution& solution, const Points& points) {
  constexpr std::size_t neighbours = 8;
  const PointTree tree(solution.positions);
  Points result(points.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    std::array<std::size_t, neighbours> index{};
    std::array<double, neighbours> squared{};
    const auto found = tree.nearest(points.row(i).data(), neighbours, index.data(), squared.data());
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    double weights = 0;
    for (std::size_t n = 0; n < found; ++n) {
      const double weight = 1.0 / (squared[n] + 1e-12);
      sum += weight * solution.displacement.row(static_cast<Eigen::Index>(index[n]));
      weights += weight;
    }
    result.row(i) = sum / weights;
  }
  return result;
}

}  // namespace brainshift::pipelines
