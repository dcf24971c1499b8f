// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pipelines/runner/stage_report.hpp"
#include "pipelines/runner/uncertainty.hpp"
#include "pipelines/scene/scene_labels.hpp"
#include "solve/load/rigid_fit.hpp"

namespace brainshift::pipelines {

/// A stage with its files: what a scene's run and the stage's own command both fill in. Empty paths are not given.
struct SegmentJob {
  ImageInputs image;
  segmentation::SegmentOptions options;  ///< by class: brain_labels, skull_label and fluid_label come from the map
  LabelReading reading = {};
  bool septa = false;                        ///< whether falx and tentorium are drawn from the label map
  std::vector<std::uint16_t> resected = {};  ///< tissues whose wall is drawn; none: no resection
};

struct DiscretiseJob {
  std::filesystem::path surface;
  std::filesystem::path labels;
  discretise::DiscretiseOptions options;
  std::optional<Load> load;                 ///< where the craniotomy is, for the refinement
  discretise::Refinement refinement;        ///< without its centres; none where the factor is 1
  std::filesystem::path wall = {};          ///< of the tissues that are resected; empty: there is none
  std::vector<std::int32_t> resected = {};  ///< those
};

struct SolveJob {
  std::filesystem::path nodes;
  std::filesystem::path cells;
  std::filesystem::path labels;
  std::filesystem::path skull;           ///< contact when given
  std::filesystem::path surface;         ///< the brain's: where faces are free, and for a simulated load
  std::filesystem::path landmarks = {};  ///< where the spread of the answer is wanted
  std::optional<Load> load;              ///< absent: what the nodes prescribe; the forces of the nodes act in any case
  std::map<std::int32_t, solve::Material> materials;
  /// Of the map, that are not of the brain; absent: not known. With them a number that has no material is refused.
  std::optional<std::set<std::uint16_t>> other_labels = {};
  solve::SolveOptions options;
  Loading loading;
  solve::Plane plane = solve::Plane::none;
  std::optional<Gravity> gravity = {};
  std::optional<Cuts> cuts = {};
  std::filesystem::path septum = {};       ///< a rigid sheet when given
  std::vector<solve::Cut> cut_paths = {};  ///< of a plane problem, those that are in no file
  std::optional<solve::Rupture> rupture = {};
  std::optional<solve::Resection> resection = {};  ///< without its wall
  std::filesystem::path wall = {};                 ///< of the resection; empty: it goes by labels
  std::filesystem::path last = {};                 ///< solution of the state before; empty: there is none
  std::optional<UncertaintyJob> uncertainty = {};  ///< absent: not wanted
};

struct RegisterJob {
  std::filesystem::path solution;
  std::filesystem::path surface;  ///< the brain's
  std::filesystem::path t1;       ///< empty: the fields take the grid of the labels, and only these are warped
  std::filesystem::path labels;
  std::filesystem::path landmarks;
  std::filesystem::path uncertainty = {};          ///< uncertainty.vtu of the solve stage; empty: there is none
  std::filesystem::path wall = {};                 ///< of what was resected; empty: nothing
  std::vector<std::int32_t> resected = {};         ///< its labels
  std::vector<std::filesystem::path> warp;         ///< images, surfaces and points to move with the same map
  std::vector<std::filesystem::path> warp_labels;  ///< label maps
  registration::RegisterOptions options;
};

/// Each reads its files, runs the stage and writes its artefacts into an existing folder. Throw std::invalid_argument
/// where the input is at fault and std::runtime_error where writing is.
StageReport run_job(const SegmentJob& job, const std::filesystem::path& out, const Progress& progress);
StageReport run_job(const DiscretiseJob& job, const std::filesystem::path& out, const Progress& progress);
StageReport run_job(const SolveJob& job, const std::filesystem::path& out, const Progress& progress);
StageReport run_job(const RegisterJob& job, const std::filesystem::path& out, const Progress& progress);

/// What a solve job's files and options say.
struct SolveInput {
  solve::Model model;
  solve::SolveOptions options;
  std::optional<solve::CraniotomyLoad> load;       ///< as it was read
  std::optional<solve::RigidMotion> registration;  ///< from image to tracker, where it is unknown
  std::vector<std::string> notes = {};             ///< of the load, for people
};
SolveInput read_input(const SolveJob& job);

/// The measured displacements of a load. surface: the brain's, for a simulated one and a field, which is looked up at
/// its vertices.
solve::CraniotomyLoad read_load(const Load& load, const std::filesystem::path& surface);

}  // namespace brainshift::pipelines
