// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "discretise/background_cells.hpp"
#include "discretise/node_cloud.hpp"
#include "segmentation/image/image.hpp"
#include "segmentation/progress.hpp"
#include "solve/boundary/essential_conditions.hpp"
#include "solve/boundary/external_force.hpp"
#include "solve/boundary/load_curve.hpp"
#include "solve/cut/cut.hpp"
#include "solve/cut/inside_body.hpp"
#include "solve/dynamics/precision.hpp"
#include "solve/held_bytes.hpp"
#include "solve/material/material.hpp"
#include "solve/solution.hpp"

namespace brainshift::solve {

/// How the volumetric part of the strain energy is integrated.
enum class Volumetric : std::uint8_t {
  mean_dilatation,  ///< pressures linear over patches of a few nodes, pressure_patches.hpp: no volumetric locking
  pointwise,        ///< the plain method
};

/// Whether derivatives are corrected for background cells that do not conform to the body.
enum class Integration : std::uint8_t {
  plain,
  consistent,  ///< make_derivatives_consistent(): the linear patch test holds
};

/// What time stepping is for.
enum class Dynamics : std::uint8_t {
  relaxation,  ///< the steady state under the full load: adaptive dynamic relaxation
  transient,   ///< the motion in time, with the physical mass
};

/// Where relaxation begins.
enum class Start : std::uint8_t {
  rest,    ///< undeformed; the load comes over load_steps
  coarse,  ///< under the full load, as a coarse cloud's solution lies: fewer steps to the same end, no way there
};

struct SolveOptions {
  ShapeOptions shape;  ///< planar is set from the model
  Volumetric volumetric = Volumetric::mean_dilatation;
  double nodes_per_patch = 8;  ///< of mean dilatation
  Integration integration = Integration::consistent;
  double consistency_defect = 0.01;  ///< what may be left of the largest defect, make_derivatives_consistent()
  Imposition imposition = Imposition::exact;
  double integration_tolerance = 0;                   ///< τ of adaptive_points(); 0: points_per_cell in every cell
  int integration_depth = 3;                          ///< of adaptive_points()
  Precision precision = Precision::double_precision;  ///< of derivatives, sums over pairs, forces of points
  int points_per_cell = 8;  ///< or part of one: hexahedra 1 or 8, tetrahedra and quads 1 or 4, triangles 1 or 3
  Dynamics dynamics = Dynamics::relaxation;
  /// Relaxation: stop when the bound of the remaining error is below this, mm, and below 1/50 of the displacement.
  double tolerance = 0.01;
  int load_steps = 400;  ///< relaxation: steps over the load's curve; more where a body may tear
  /// Relaxation of a whole body in space. A coarse start is one from rest all the same for a body that is cut, torn or
  /// resected, where snapshots are wanted or the load's curve does not end at 1, and where the coarse cloud cannot be
  /// solved or its solution does not hold.
  Start start = Start::rest;
  double time_step = 0;  ///< transient: s; 0: nine tenths of the critical one
  double damping = 0;    ///< transient: c of eq 26, 1/s
  int max_steps = 50000;
  double region = 0;       ///< mm; only what a coarse solution moves by more is solved, region.hpp; 0: the whole body
  int snapshot_every = 0;  ///< steps between displacements kept for steps.pvd, each 20th at the most; 0: none
};

/// Three dimensions, or a plane problem on nodes and cells with z = 0; forces are then per mm of thickness.
enum class Plane : std::uint8_t { none, strain, stress };

/// What is solved.
struct Model {
  NodeCloud cloud;  ///< prescribed_displacement holds the essential conditions
  BackgroundCells cells;
  std::optional<LabelMap> labels;              ///< tissue at an integration point; absent, or 0 there: the cell's label
  std::map<std::int32_t, Material> materials;  ///< by label
  std::optional<Surface> skull;                ///< rigid, frictionless contact from inside; absent: none
  Plane plane = Plane::none;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< m/s²
  BodyForce body_force = {};                          ///< N/mm³ undeformed; empty: none
  std::vector<Cut> cuts = {};
  bool face_contact = false;  ///< of cuts: their faces do not pass through each other
  std::optional<Rupture> rupture = {};
  std::optional<Resection> resection = {};
  LoadCurve curve = {};  ///< of prescribed displacements and all forces; in a transient run its times are seconds
};

/// A row of history.csv.
struct HistoryRow {
  int step = 0;
  double time = 0;                                     ///< relaxation: share of the load's curve, 0 to 1; transient: s
  double external_work = 0;                            ///< mJ
  double strain_energy = 0;                            ///< mJ
  double kinetic_energy = 0;                           ///< mJ, fictitious in dynamic relaxation
  double dissipated_energy = 0;                        ///< mJ, by the damping
  Eigen::Vector3d reaction = Eigen::Vector3d::Zero();  ///< N, sum over the nodes whose prescribed displacement is not 0
  double residual = 0;     ///< sum of |f_int - reactions| / sum of |f_int|, or the largest of that at rest so far
  double error_bound = 0;  ///< mm; infinite until it is estimated
};

/// The displacement on the way to the end state.
struct Snapshot {
  int step = 0;
  double time = 0;                     ///< as in HistoryRow
  Points displacement = Points(0, 3);  ///< mm, in the cloud's order, then the nodes that a cut added
  Points positions = Points(0, 3);  ///< undeformed, mm, of a body that is cut on the way; else no rows: the solution's
  CutFacets cut = {};               ///< then; else the solution's
};

/// What became of the contact of faces, at the end.
struct FaceMeasures {
  std::size_t touching_nodes = 0;  ///< that overlap the opposite face or are within a hundredth of the spacing of it
  double largest_overlap = 0;      ///< mm more than undeformed
};

/// What cutting took.
struct CutMeasures {
  std::size_t split_nodes = 0;        ///< nodes of the cloud that were split in two
  std::size_t added_nodes = 0;        ///< their twins, and pairs where there was no node to split
  std::size_t advances = 0;           ///< times the body was cut further while it moved
  std::size_t touched_supports = 0;   ///< of integration points, evaluated again; over all advances
  double extent = 0;                  ///< length, mm, or area, mm²
  double seconds = 0;                 ///< of the advances
  std::optional<FaceMeasures> faces;  ///< of face contact; absent: it was not asked for
};

/// What a resection took.
struct ResectionMeasures {
  std::size_t removed_nodes = 0;
  double removed_volume = 0;  ///< of the integration points of its tissue, mm³
};

struct SolveMeasures {
  std::size_t nodes = 0;
  std::size_t integration_points = 0;
  std::size_t capped_points = 0;  ///< integration points that missed the integration tolerance
  std::size_t pairs = 0;          ///< (integration point, node) pairs
  double mean_support = 0;        ///< nodes an integration point
  std::size_t grown_supports = 0;
  std::size_t outside_label = 0;  ///< integration points that took their cell's label
  std::size_t loaded_nodes = 0;
  std::size_t contact_nodes = 0;  ///< in touch at the end
  int steps = 0;
  bool converged = false;
  double error_bound = 0;           ///< mm
  double critical_step = 0;         ///< transient: as estimated for the undeformed body, s
  int consistency_iterations = 0;   ///< of the correction of the derivatives
  double largest_displacement = 0;  ///< mm
  double constraint_error = 0;      ///< largest |Σφû − prescribed|, mm
  double largest_penetration = 0;   ///< deepest node outside the skull, mm
  double smallest_jacobian = 0;     ///< least det F over integration points
  double largest_stretch = 0;       ///< largest principal stretch
  double compressed_share = 0;      ///< of the volume, pressed so far that its free faces may crease
  std::optional<CutMeasures> cut;   ///< absent: nothing was cut
  std::optional<ResectionMeasures> resection;
  double seconds_setup = 0;
  double seconds_stepping = 0;
  HeldBytes bytes;
  std::size_t region_nodes = 0;  ///< solved, those at the region's rim too; 0: no region was asked for
  double seconds_coarse = 0;     ///< of the coarse solution that chose the region or was the start
  double coarse_error = 0;       ///< of it, largest next to the region's rim, mm: what the outside may be wrong by
};

struct SolveResult {
  Solution solution;  ///< the last good state, also when not converged
  std::vector<HistoryRow> history;
  std::vector<Snapshot> snapshots;
  std::optional<InsideBody> inside;  ///< of a model with cuts
  SolveMeasures measures;
  std::string failure;  ///< empty when converged; else one sentence: what went wrong, where and when (exit 3)
};

/// Runs the stage: MTLED, to the steady state by adaptive dynamic relaxation or in time. Of a resection the solution
/// holds the nodes that it leaves, in the cloud's order. Throws std::invalid_argument when the model cannot be solved:
/// a label without a material, too few nodes for a support, constraints that contradict each other, nothing that holds
/// the body or a piece of it, a plane problem with contact or cells of three dimensions.
SolveResult solve(const Model& model, const SolveOptions& options, const Progress& progress = {});

/// Writes steps/NNNNNN.vtu, one a snapshot, of a body that is cut steps/NNNNNN_cut.vtp too (cut_surface.hpp), and
/// steps.pvd that ParaView plays, into the folder.
void write_steps(const std::filesystem::path& folder, const SolveResult& result);

void write_history(const std::filesystem::path& file, const std::vector<HistoryRow>& history);

}  // namespace brainshift::solve
