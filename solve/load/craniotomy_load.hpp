// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "discretise/node_cloud.hpp"
#include "segmentation/surface/surface.hpp"

namespace brainshift::solve {

/// Displacements measured on the exposed cortex.
struct CraniotomyLoad {
  Points positions;     ///< preop, mm, LPS
  Points displacement;  ///< to intraop, mm
};

/// Reads `x,y,z,ux,uy,uz` (mm). The header line is required; the frame is named by a comment line before it, "# frame:
/// LPS" or "# frame: RAS". Throws std::invalid_argument with file and line where a line does not parse, is not finite,
/// the frame is not named, or nothing is measured.
CraniotomyLoad read_craniotomy_csv(const std::filesystem::path& file);
void write_craniotomy_csv(const std::filesystem::path& file, const CraniotomyLoad& load);

/// Two 3D Slicer markups of the same points, before and after (.mrk.json or .fcsv, RAS or LPS as the file says),
/// matched by label, else by order.
CraniotomyLoad read_markups(const std::filesystem::path& before, const std::filesystem::path& after);

/// Markup positions alone (landmarks), (n × 3) mm LPS.
Points read_markup_positions(const std::filesystem::path& file);

/// Two surfaces of the exposed cortex: the displacement at the vertices of `before` is to the nearest place of `after`,
/// smoothed over the surface (the nearest place alone slides and folds; limits in the README).
CraniotomyLoad load_from_surfaces(const Surface& before, const Surface& after);

struct OpeningOptions {
  double margin = -1;      ///< how far past the outermost measured points the opening reaches, mm; negative: half their
                           ///< median distance to each other
  double farthest = 20.0;  ///< a measured point farther than this from any surface node is an error, mm
};

/// Extends the measured displacements to the surface nodes under the opening: those whose projection on the best-fit
/// plane of the measured points lies in their convex hull widened by the margin, and that are near them in depth too.
/// All other components stay free (NaN). Returns (n × 3), one row a node. Throws std::invalid_argument, with the
/// distance and the point, on a point too far from the surface (a wrong frame, most often: says so if flipping x and y
/// would bring it near), and when no node is loaded.
Points prescribed_on_surface_nodes(const NodeCloud& cloud, const CraniotomyLoad& load,
                                   const OpeningOptions& options = {});

}  // namespace brainshift::solve
