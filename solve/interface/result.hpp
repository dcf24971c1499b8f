// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solve/interface/solution.hpp"

namespace brainshift::solve {

/// A row of history.csv.
struct HistoryRow {
  int step = 0;
  double time = 0;               ///< relaxation: share of the load's curve, 0 to 1; transient: s, before the step
  double external_work = 0;      ///< mJ
  double strain_energy = 0;      ///< mJ
  double kinetic_energy = 0;     ///< mJ, fictitious in dynamic relaxation
  double dissipated_energy = 0;  ///< mJ, by the damping, by contact with skull and septa, and as masses and cuts change
  Eigen::Vector3d reaction = Eigen::Vector3d::Zero();  ///< N, sum over the nodes whose prescribed displacement is not 0
  double residual = 0;     ///< sum of |f_int - reactions| / sum of |f_int|, or the largest of that at rest so far
  double error_bound = 0;  ///< mm; infinite until it is estimated
};

/// The two faces of a cut inside the body, drawn half a spacing fine: lines in a plane problem, triangles in space.
struct CutSurface {
  Points vertices = Points(0, 3);      ///< undeformed, mm: those of the face above, then the same of that below
  Triangles facets = Triangles(0, 3);  ///< of a line the third vertex is -1
  Points displacement = Points(0, 3);  ///< of the face at each vertex, mm
  std::vector<std::int32_t> side;      ///< of each vertex: 1 above, on the side of the cut's normal; -1 below
};

/// The displacement on the way to the end state.
struct Snapshot {
  int step = 0;
  double time = 0;                     ///< after the step: share of the load's curve, or s
  Points displacement = Points(0, 3);  ///< mm, in the cloud's order, then the nodes that a cut added
  Points positions = Points(0, 3);     ///< undeformed, mm; fewer than the solution's where a cut has added nodes since
  CutFacets cut = {};                  ///< as far as it had come
  CutSurface faces = {};               ///< of that cut; without vertices where nothing is cut
};

/// A row of stress_strain.csv.
struct StressStrainRow {
  double time;        ///< as in HistoryRow
  double elongation;  ///< of the body between its held and its loaded nodes, over its length
  double stress;      ///< nominal: reaction along the load over the mean undeformed cross-section, volume / length, Pa
};

/// What became of the contact of faces, at the end.
struct FaceMeasures {
  std::size_t touching_nodes = 0;  ///< that overlap the opposite face or are within a hundredth of the spacing of it
  double largest_overlap = 0;      ///< mm more than undeformed, times the presence of what is overlapped
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

/// What a septum took, and what became of the contact with it.
struct SeptumMeasures {
  double area = 0;                 ///< of the sheet, mm²
  std::size_t face_nodes = 0;      ///< on its two sides
  std::size_t touching_nodes = 0;  ///< in touch at the end
  double largest_penetration = 0;  ///< deepest node behind its wall, mm
};

/// What a resection took.
struct ResectionMeasures {
  std::size_t removed_nodes = 0;
  double removed_volume = 0;  ///< of the integration points of its tissue, mm³
  // where its wall is a surface
  std::size_t wall_nodes = 0;         ///< 0: it is none
  double wall_area = 0;               ///< undeformed, mm²
  std::optional<double> volume = {};  ///< of the cavity at the end, mm³; absent where it lies open
  FaceMeasures touch = {};            ///< of the wall with itself
};

/// A weight that was tried for a load with noise, as a linear body would answer it.
struct WeightRow {
  double weight = 0;          ///< s, mJ
  double misfit = 0;          ///< Σ r²/σ² over the components of the measured points that were used
  double energy = 0;          ///< of the deformation, mJ
  double log_likelihood = 0;  ///< restricted, choose_weight()
};

/// A motion of the opening that is alike at places near each other: a Gaussian with the covariance
///   (along² e eᵀ + across² (I − e eᵀ)) exp(−|x − y|²/(2 length²)), e the direction.
struct SmoothMotion {
  double length = 0;             ///< mm; 0: there is none
  double along = 0, across = 0;  ///< standard deviations, mm
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  bool fades = false;  ///< towards the rim of the opening
};

/// How the noise of a load was weighed.
struct MeasuredFit {
  double weight = 0;    ///< s that was used, mJ
  SmoothMotion smooth;  ///< what the points say of it
  bool rough = false;   ///< alike over the shortest length that was tried, and no likelier than noise so far larger
  /// The likeliest, where the points are as likely without: in what is said of errors, not in the answer's prior.
  SmoothMotion refused;
  SmoothMotion hidden;  ///< of the opening, beside which an unknown registration is found; not in the answer's prior
  /// (m × 3) mm: with a smooth motion, the displacement of each point of the cortex as prior and noise have it.
  Points smoothed = Points(0, 3);
  double noise_factor = 1;  ///< of the standard deviations, by which what was measured differs from what was given
  std::vector<WeightRow> weights;  ///< that were tried, ascending; none: the weight was given
  /// (6) the rigid motion in what was measured, rigid_motions() about its points, and its standard deviation, mm; not
  /// of a body that is held in a registered image.
  Eigen::VectorXd motion, motion_deviation;
  Eigen::Vector3d motion_centre = Eigen::Vector3d::Zero();  ///< of its turns, mm
  double motion_size = 1;                                   ///< mm a turn of 1 moves by
  /// (asked × 6) mm²: xx, yy, zz, xy, yz, zx of the displacement at the places that were asked for.
  Eigen::MatrixXd covariance;
  Points linear = Points(0, 3);  ///< (asked × 3) mm: that displacement as the linear body of the fit has it
};

/// Below this stretch a free face of soft matter creases under uniaxial compression (Hong, Zhao & Suo 2009).
inline constexpr double crease_stretch = 0.56;

/// A share of the volume below it with which a body folds. A cube that swells by a fifth in a skull that leaves it no
/// room folds within, and sheds its pressure by that: 7 % of it are then pressed so far.
inline constexpr double much_compressed = 0.05;

/// Over the shear modulus: pressures of patches above it may move points to where they should not go. Measured on
/// blocks all of whose surface is prescribed, two hundred nodes: at 5 exact, at 10 wrong by a fifth of what is imposed.
inline constexpr double most_pressure = 6;

/// A share of the volume above it that is more than a rim: bonded slabs a ninth as thick as wide have a hundredth.
inline constexpr double much_pressed = 0.1;

/// Something that the nodes hardly resolve.
struct ThinPart {
  std::string what;  ///< "the moved patch", "the held patch", "tissue 2"
  double spacings;   ///< of the nodes, that it is across
  bool is_tissue = false;
};

struct SolveMeasures {
  std::size_t nodes = 0;
  std::size_t integration_points = 0;
  std::size_t capped_points = 0;  ///< integration points that missed the integration tolerance
  /// Integration points a node where they are fewest, inside the body; infinite where none is inside.
  double fewest_points = std::numeric_limits<double>::infinity();
  std::size_t pairs = 0;    ///< (integration point, node) pairs
  double mean_support = 0;  ///< nodes an integration point
  std::size_t grown_supports = 0;
  std::size_t outside_label = 0;  ///< integration points that took their cell's label
  std::size_t loaded_nodes = 0;
  std::size_t contact_nodes = 0;  ///< in touch at the end
  int steps = 0;
  bool single_precision = false;  ///< of derivatives; double where materials differ too much, whatever was asked for
  bool converged = false;
  std::string took;                          ///< what it was solved with where not as asked for; else empty
  double error_bound = 0;                    ///< mm
  double critical_step = 0;                  ///< transient: as estimated for the undeformed body, s
  int consistency_iterations = 0;            ///< of the correction of the derivatives
  double largest_displacement = 0;           ///< mm
  double constraint_error = 0;               ///< largest |Σφû − prescribed|, mm, where it is imposed (PatchRim)
  double largest_penetration = 0;            ///< deepest node outside the skull, mm
  double smallest_jacobian = 0;              ///< least det F over integration points; at most 1
  double largest_stretch = 0;                ///< largest principal stretch
  double compressed_share = 0;               ///< of the volume, pressed so far that its free faces may crease
  double pressed_share = 0;                  ///< of the volume, patches under a pressure above most_pressure
  std::vector<ThinPart> thin;                ///< see thin_parts()
  std::optional<double> estimated_error_95;  ///< 95 % of the nodes' estimates, mm, see estimated_error()
  std::optional<CutMeasures> cut;            ///< absent: nothing was cut
  std::optional<SeptumMeasures> septum;
  std::optional<ResectionMeasures> resection;
  std::optional<MeasuredFit> measured;  ///< absent: the load is held exactly
  double seconds_setup = 0;
  double seconds_stepping = 0;
  std::size_t region_nodes = 0;  ///< solved, those at the region's rim too; 0: no region was asked for
  double seconds_coarse = 0;     ///< of the coarse solution that chose the region, was the start or told the error
  double coarse_error = 0;       ///< of it, largest next to the region's rim, mm: what the outside may be wrong by
};

struct SolveResult {
  Solution solution;  ///< the last good state, also when not converged
  std::vector<HistoryRow> history;
  std::vector<Snapshot> snapshots;
  std::vector<StressStrainRow> stress_strain;  ///< of a model with a rupture
  CutSurface faces;                            ///< of the cut at the end; without vertices where nothing is cut
  SolveMeasures measures;
  std::string failure;    ///< empty when converged; else one sentence: what went wrong, where and when (exit 3)
  bool unstable = false;  ///< failed because it blew up, not for want of steps
  bool rounded = false;   ///< failed for want of double precision
};

}  // namespace brainshift::solve
