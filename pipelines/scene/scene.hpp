// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "discretise/discretise.hpp"
#include "pipelines/scene/gravity.hpp"
#include "pipelines/scene/tradeoff_lists.hpp"
#include "register/registration.hpp"
#include "segmentation/segment.hpp"
#include "solve/cut/cut_timing.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/solve.hpp"
#include "solve/uncertainty/uncertainty_options.hpp"

namespace brainshift::pipelines {

/// The stages in the order in which they run.
enum class StageId : std::uint8_t { segment, discretise, solve, registration, report };
inline constexpr std::array<StageId, 5> all_stages = {StageId::segment, StageId::discretise, StageId::solve,
                                                      StageId::registration, StageId::report};

/// "segment", "discretise", "solve", "register", "report": in scenes, on the command line and as folders of a run.
std::string_view stage_name(StageId stage);
/// Throws std::invalid_argument, listing the names, on another name.
StageId stage_from_name(std::string_view name);
/// Whether a stage has this name.
bool is_stage(std::string_view name);

struct ImageInputs {
  std::filesystem::path t1;
  std::filesystem::path labels;
  std::string labels_are;  ///< "freesurfer", "brats", a table's file, or empty: recognised, or named by the tissues
  std::filesystem::path brain_mask;
  std::filesystem::path tumour_mask;
  std::filesystem::path tumour;  ///< a label map of the tumour, in the numbers of BraTS or a mask
  std::filesystem::path surface;
  /// labels of the label map that are not tissue of the brain; every other label must have a tissue
  std::vector<std::uint16_t> other_labels = {segmentation::default_label::csf, segmentation::default_label::skull,
                                             segmentation::default_label::skin};
  std::optional<std::uint16_t> skull_label;
};

struct Tissue {
  std::uint16_t label = 0;
  std::string name;
  std::string named_material;  ///< the constants were those of solve::named_material before others were set; or empty
  solve::Material material;
  std::vector<std::uint16_t> labels = {};  ///< numbers of the map that are this tissue, `label` the first; or empty
  std::uint16_t tissue_class = 0;  ///< of segmentation::default_label, where named by it: `label` is the same; or 0
};

struct BeforeAfter {
  std::filesystem::path before;
  std::filesystem::path after;
};

/// Another program's registration of the preop to the intraop brain.
struct FieldLoad {
  std::filesystem::path file;   ///< field or transform, registration::read_place_map()
  std::filesystem::path where;  ///< a surface over the opening, or markups about it; empty: all of the brain's surface
  enum class Moves : std::uint8_t { by_name, points, image } moves = Moves::by_name;  ///< registration::Moves
};

/// What is measured and imposed: at most one of the five.
struct Load {
  solve::OpeningOptions opening;
  std::optional<double> noise;                      ///< standard deviation where the file says none, mm; absent: exact
  double weight = 0;                                ///< s of solve::Measurement, mJ; 0: chosen
  bool robust = false;                              ///< points that contradict the others count for less
  bool registration_unknown = false;                ///< what was measured holds the error of the patient's registration
  std::optional<std::filesystem::path> craniotomy;  ///< craniotomy.csv
  std::optional<BeforeAfter> markups;
  std::optional<BeforeAfter> surfaces;
  std::optional<FieldLoad> field = {};
  std::optional<solve::SimulatedCraniotomy> simulated;

  bool empty() const { return !craniotomy && !markups && !surfaces && !field && !simulated; }
};

struct Contact {
  std::filesystem::path skull;  ///< empty: the skull of the segment stage
};

struct CutFile {
  std::filesystem::path file;
  solve::CutTiming timing;
};

struct Cuts {
  bool contact = false;  ///< their faces do not pass through each other
  std::vector<CutFile> files;
};

/// Falx and tentorium from the label map, by FreeSurfer's numbers.
struct Septa {};

struct SeptumFile {
  std::filesystem::path file;
};

/// Reads a cut. Throws std::invalid_argument, naming the file, when it is at fault, a path of a body in space or a
/// sheet of a plane problem.
solve::Cut read_cut(const CutFile& cut, solve::Plane plane);

/// How the load and all forces come over time, and the weight.
struct Loading {
  std::optional<double> duration;  ///< of the 3-4-5 curve in a transient run, s; absent: 1
  std::filesystem::path curve;     ///< CSV time,factor in place of it; empty: none
  solve::LoadCurve::Join curve_join = solve::LoadCurve::Join::smooth;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< m/s², LPS
};

/// The curve that the loading asks for. Throws std::invalid_argument, naming file and line, when its file is at fault.
solve::LoadCurve load_curve(const Loading& loading);

/// A whole-number index for arrays with one entry a stage.
constexpr std::size_t index_of(StageId stage) {
  return static_cast<std::size_t>(stage);
}

/// Where a value of the scene was written, for messages: line of the scene's file, or 0 for the command line. The key
/// is the path of an option ("segment.edge_length") or element ("load.simulated").
struct SceneSource {
  std::filesystem::path file;
  std::map<std::string, int> lines;
};

/// What a scene does not say: it is solved for where the brain ends, not for the way there, and to a micrometre.
inline solve::SolveOptions quickest() {
  solve::SolveOptions options;
  options.start = solve::Start::coarse;
  options.precision = solve::Precision::single_precision;
  return options;
}

/// Which state of a sequence a scene is.
struct StateOfSequence {
  std::string name;
  std::string before;  ///< the state that it goes on from; empty: it is the first
  // All states have the nodes of the first, which follow from its load and where its tissues differ.
  std::optional<Load> opening = {};
  std::vector<Tissue> tissues = {};
};

/// The whole problem. Members that are empty are parts that the scene does not name: they are not built. File names are
/// absolute, or relative to the working directory where no file or --set gave them.
struct Scene {
  ImageInputs image;
  std::vector<Tissue> tissues;
  std::optional<Load> load;
  std::optional<Contact> contact;
  std::optional<Gravity> gravity;
  std::optional<Cuts> cuts;
  std::optional<Septa> septa;
  std::optional<SeptumFile> septum;
  std::optional<solve::Resection> resection;
  std::optional<std::filesystem::path> landmarks;
  std::optional<solve::UncertaintyOptions> uncertainty;
  std::optional<TradeoffLists> tradeoff;
  segmentation::SegmentOptions segment;  ///< brain_labels and skull_label are filled in from tissues and image
  discretise::DiscretiseOptions discretise = {.tissue_boundary_factor = 0.6};
  discretise::Refinement refinement = {.centres = {}, .radius = 3, .factor = 0.5};  ///< at the load, which says where
  solve::SolveOptions solve = quickest();
  Loading loading;
  registration::RegisterOptions registration;
  std::array<std::string, all_stages.size()> commands;  ///< external commands that replace stages; empty: our own stage
  SceneSource source;
  std::optional<StateOfSequence> state = {};
  std::vector<Scene> states = {};  ///< an operation in order, each the whole scene of its state; none: no sequence
};

/// Whether the scene has what the stage needs: register and report a T1, or a label map in its place.
bool is_active(StageId stage, const Scene& scene);

/// Whether the stage is this library's own, not another program's.
bool is_ours(const Scene& scene, StageId stage);

/// "scene.xml:12" where the option or element was written, "--set" for the command line, the file alone when unknown.
std::string place(const SceneSource& source, const std::string& path);

}  // namespace brainshift::pipelines
