// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/run_data.hpp"

#include <array>
#include <fstream>
#include <nanoflann.hpp>
#include <sstream>
#include <stdexcept>

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
  using Value = decltype(read(file));
  return !file.empty() && fs::exists(file) ? std::optional<Value>(read(file)) : std::nullopt;
}

using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Points, 3, nanoflann::metric_L2_Simple>;

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
  run.warped = read_if_there(run_folder / "register/warped.nii.gz", image);
  run.forward = read_if_there(run_folder / "register/preop_to_intraop.nii.gz",
                              [](const fs::path& file) { return read_vector_image(file); });
  run.brain = read_if_there(run_folder / "segment/brain.vtp", [](const fs::path& file) { return read_surface(file); });
  run.solution =
      read_if_there(run_folder / "solve/solution.vtu", [](const fs::path& file) { return read_solution(file); });
  if (fs::exists(run_folder / "solve/history.csv")) {
    run.history = read_history(run_folder / "solve/history.csv");
  }
  return run;
}

std::vector<solve::HistoryRow> read_history(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  std::vector<solve::HistoryRow> rows;
  for (int number = 2; std::getline(stream, line); ++number) {
    std::istringstream fields(line);
    std::array<double, 7> values{};
    std::string field;
    std::size_t count = 0;
    while (count < values.size() && std::getline(fields, field, ',')) {
      char* end = nullptr;
      values[count] = std::strtod(field.c_str(), &end);  // reads nan too, which streams do not
      count += end != field.c_str() ? 1 : values.size() + 1;
    }
    if (count != values.size()) {
      throw std::invalid_argument(file.string() + ", line " + std::to_string(number) +
                                  ": seven numbers expected, found '" + line + "'");
    }
    rows.push_back({static_cast<int>(values[0]), values[1], values[2], values[3], values[4], values[5], values[6]});
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
  const Tree tree(3, std::cref(solution.positions), 10);
  Points result(points.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    std::array<Eigen::Index, neighbours> index{};
    std::array<double, neighbours> squared{};
    const auto found = tree.index->knnSearch(points.row(i).data(), neighbours, index.data(), squared.data());
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    double weights = 0;
    for (std::size_t n = 0; n < found; ++n) {
      const double weight = 1.0 / (squared[n] + 1e-12);
      sum += weight * solution.displacement.row(index[n]);
      weights += weight;
    }
    result.row(i) = sum / weights;
  }
  return result;
}

}  // namespace brainshift::pipelines
