// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "discretise/interface/background_cells.hpp"
#include "discretise/interface/node_cloud.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/conditions.hpp"
#include "solve/interface/cut.hpp"
#include "solve/interface/load_curve.hpp"
#include "solve/interface/solution.hpp"
#include "solve/material/material.hpp"

namespace brainshift::solve {

/// Force per undeformed volume at an undeformed place (mm) and label, N/mm³.
using BodyForce = std::function<Eigen::Vector3d(const Eigen::Vector3d& position, std::int32_t label)>;

/// The fluid that held the body when it was imaged, drained to a level. The image shows a state of rest, so only the
/// change of the load acts: tissue above the level has lost its buoyancy, and a patient who was turned weighs another
/// way. Where the tissue lies is taken from the undeformed body.
struct DrainedFluid {
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();           ///< m/s², now
  Eigen::Vector3d gravity_of_image = Eigen::Vector3d::Zero();  ///< m/s², when the image was taken
  double level = 0;                                            ///< mm along gravity: what lies less far is above it
  double density = 1007;                                       ///< kg/m³
};

/// A stiff sheet in the undeformed body that stays where it is, with tissue on both sides: rigid, for it is some ten
/// thousand times as stiff as tissue and held at its rim. Tissue is not seen across it, slides along it without
/// friction and does not pass through it. Where it ends inside the body the tissue is one piece.
struct Septum {
  std::string name;  ///< for messages: the file
  Surface sheet;     ///< mm, LPS; it may branch, be in pieces, have holes and reach out of the body
};

/// Three dimensions, or a plane problem on nodes and cells with z = 0; forces are then per mm of thickness.
enum class Plane : std::uint8_t { none, strain, stress };

/// What is solved.
struct Model {
  NodeCloud cloud;
  Conditions conditions = {};  ///< at its nodes
  BackgroundCells cells;
  std::optional<Surface> boundary = {};        ///< the body's, closed; absent: that of the cells where they conform
  std::optional<LabelMap> labels;              ///< tissue at an integration point; absent, or 0 there: the cell's label
  std::map<std::int32_t, Material> materials;  ///< by label
  /// Which tissue sees whose nodes follows from these; empty: from `materials`. Samples keep those of their answer.
  std::map<std::int32_t, Material> contrast = {};
  std::optional<Surface> skull;  ///< rigid, frictionless contact from inside; absent: none
  Plane plane = Plane::none;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< m/s²
  std::optional<DrainedFluid> fluid = {};             ///< what its draining changes; absent: nothing
  BodyForce body_force = {};                          ///< N/mm³ undeformed; empty: none
  std::vector<Cut> cuts = {};
  bool face_contact = false;          ///< of cuts: their faces do not pass through each other
  std::optional<Septum> septum = {};  ///< a rigid sheet inside the body; absent: none
  std::optional<Rupture> rupture = {};
  std::optional<Resection> resection = {};
  /// The state of rest before this one, maybe on another cloud: where a coarse start begins. Absent: there is none.
  std::optional<Solution> last = {};
  LoadCurve curve = {};  ///< of prescribed displacements and all forces; in a transient run its times are seconds
};

}  // namespace brainshift::solve
