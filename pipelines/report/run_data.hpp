// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"
#include "solve/solve.hpp"

namespace brainshift::pipelines {

/// What a run folder holds that the report shows. Parts that the run did not make are empty.
struct RunData {
  nlohmann::json record;  ///< run.json, where outdated stages have no more than that
  std::optional<ScalarImage> t1;
  std::optional<ScalarImage> warped;
  std::optional<VectorImage> forward;  ///< preop point -> displacement
  std::optional<Surface> brain;
  std::optional<Solution> solution;
  std::string history;                  ///< text of solve/history.csv
  std::optional<LabelMap> labels = {};  ///< as the stages understood them
  std::optional<LabelMap> closed = {};  ///< 1 where closing took in what no label called brain
  std::optional<LabelMap> warped_labels = {};
  std::optional<ScalarImage> jacobian = {};  ///< volume ratio at preop points
  std::string load = {};                     ///< text of solve/load.csv
  std::string uncertainty = {};              ///< text of solve/uncertainty.csv
  std::vector<double> deviation = {};        ///< of the displacement at the solution's nodes, mm; none: not sampled
  std::optional<Surface> septum = {};        ///< rigid sheets along which tissue slid
  std::string no_image = {};                 ///< why there are no images before and after; empty: there are
};

/// What an outdated stage left, or another T1 than the run's in its place, is not taken. Throws std::invalid_argument,
/// naming the file, when the folder holds no run.json or something that cannot be read, nlohmann::json::exception when
/// run.json is no record of a run.
RunData read_run(const std::filesystem::path& run_folder);

/// What time stepping was for, from run.json's options; relaxation where they do not say.
solve::Dynamics dynamics_of(const nlohmann::json& record);

/// Labels that the run's resection takes out.
std::vector<std::uint16_t> resected_labels(const nlohmann::json& record);

/// The nodes on which a displacement was imposed (those with a reaction), (n × 3) mm; no row where there are none.
Points loaded_positions(const Solution& solution);

}  // namespace brainshift::pipelines
