// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "discretise/interface/node_cloud.hpp"
#include "segmentation/geometry/surface.hpp"

namespace brainshift::solve {

/// Displacements measured on the exposed cortex; one row a point.
struct CraniotomyLoad {
  Points positions;     ///< preop, mm, LPS
  Points displacement;  ///< to intraop, mm, LPS
  /// Standard deviation of the displacement along each axis, mm, from smallest_noise on. No rows: not known, the load
  /// is imposed exactly.
  Points sigma = Points(0, 3);
  bool paired_by_order = false;  ///< of two markups that share no label
};

/// mm: below it a standard deviation is no noise but a slip.
inline constexpr double smallest_noise = 1e-6;

/// Reads `x,y,z,ux,uy,uz` (mm). That header line is required; a comment line before it names the frame, "# frame: LPS"
/// or "# frame: RAS" (converted). A column `sigma`, or three, `sigma_x,sigma_y,sigma_z`, hold standard deviations (mm).
/// Throws std::invalid_argument with file and line where a standard deviation is less than smallest_noise, and where a
/// line does not parse or is not finite, or the frame is not named; with the file where it cannot be read, holds no
/// measurement, or has a column that is most likely a standard deviation under another name.
CraniotomyLoad read_craniotomy_csv(const std::filesystem::path& file);

/// Writes the same, in LPS; numbers survive unchanged. Throws std::runtime_error when it cannot be written whole.
void write_craniotomy_csv(const std::filesystem::path& file, const CraniotomyLoad& load);

/// Two 3D Slicer markups of the same points, before and after (.mrk.json or .fcsv, RAS or LPS as the file says, an
/// error if it does not). Matched by label, whatever its case, where the two name the same points; by order where they
/// share no label and are equally many. Throws std::invalid_argument, naming file and point, otherwise.
CraniotomyLoad read_markups(const std::filesystem::path& before, const std::filesystem::path& after);

/// Markup positions alone (landmarks), (n × 3) mm LPS, in the file's order.
Points read_markup_positions(const std::filesystem::path& file);

/// Two surfaces of the exposed cortex: displacements at the vertices of `before` that lay it on `after`, by smooth
/// non-rigid registration (nearest places along normals, the smoothing relaxed step by step; Amberg et al. 2007).
/// Limits: movement along the surface is not seen, only smoothed; places whose partner lies past the rim of `after`
/// take their neighbours' movement. Throws std::invalid_argument on an empty or non-finite surface, and where the two
/// are farther apart than a brain shifts (20 mm in the median) or less than a fifth of `before` lies over `after`.
CraniotomyLoad load_from_surfaces(const Surface& before, const Surface& after);

/// An opening in the skull and how far the brain sinks in it: a simulation, for demonstration and tests where nothing
/// was measured.
struct SimulatedCraniotomy {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mm, LPS; the nearest place of the brain's surface is taken
  double radius = 28.0;                              ///< mm, in the plane of the opening
  double depth = 8.0;                                ///< displacement at the centre, mm
};

/// What might be measured in such an opening: the brain surface's vertices under it, displaced along the opening's mean
/// inward normal by `depth` at the centre, falling smoothly to a twentieth of it at the rim (measured shifts are
/// largest amid the opening and 0-1 mm at its rim). Throws std::invalid_argument on a number that load_options.cpp does
/// not allow, and when fewer than three vertices lie under the opening.
CraniotomyLoad simulated_craniotomy(const Surface& brain, const SimulatedCraniotomy& opening);

/// What each may be stands in load_options.cpp.
struct OpeningOptions {
  /// How far past the outermost measured points the opening reaches, mm. Negative: half the median distance from a
  /// point to its nearest neighbour, 5 mm at most (a single point: the spacing of the nearest node).
  double margin = -1;
  double depth = 10.0;     ///< a node this far above or below the measured surface is not under the opening, mm
  double farthest = 20.0;  ///< a measured point farther than this from any surface node is an error, mm
};

/// Extends the measured displacements to the surface nodes under the opening: those whose projection on the best-fit
/// plane of the measured points lies in their convex hull widened by the margin, or beyond it by a quarter of their
/// spacing, and that are near them in depth too. All other components stay free (NaN). Between the points by thin-plate
/// splines of the nearest ones, kept within the measured values by a tenth of their range. Openings that lie apart
/// (openings()) each by itself. Returns (n × 3) mm, one row a node. Throws std::invalid_argument on an option out of
/// range; on no measured point or one that is not finite; with the distance and the point, on one too far from the
/// surface (a wrong frame, most often: says so if flipping x and y would bring it near) or that moves by more than half
/// of the body; on points of more than one side of the brain; and when no node is loaded.
Points prescribed_on_surface_nodes(const NodeCloud& cloud, const CraniotomyLoad& load,
                                   const OpeningOptions& options = {});

/// Where the opening ends on the surface of the brain (mm): places at most half a millimetre apart, on its triangles,
/// which should be smaller than the opening. Nodes there make a load act as wide as it is. Points inside the brain do
/// not count. None where all points lie in one place. Throws std::invalid_argument on an option out of range.
Points opening_rim(const Surface& brain, const CraniotomyLoad& load, const OpeningOptions& options = {});

}  // namespace brainshift::solve
