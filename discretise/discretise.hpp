// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "discretise/background_cells.hpp"
#include "discretise/node_cloud.hpp"
#include "segmentation/image/image.hpp"
#include "segmentation/progress.hpp"
#include "segmentation/surface/surface.hpp"

namespace brainshift::discretise {

/// Finer nodes near a place: within `radius` mm of any of the points the spacing is multiplied by `factor`, growing
/// back to the uniform one over the same distance again.
struct Refinement {
  Points centres;
  double radius = 20.0;
  double factor = 0.5;
};

struct DiscretiseOptions {
  std::optional<double> spacing;     ///< mm; give this or nodes, not both
  std::optional<std::size_t> nodes;  ///< wanted number of nodes, met within 5 %; default 12,000 when neither is given
  double minimum_distance = 0.5;     ///< no node nearer to another than this fraction of its spacing; 0 to 0.7
  std::optional<Refinement> craniotomy;  ///< finer towards the opening
  double tumour_factor = 1.0;            ///< spacing inside and at a tumour / uniform spacing
  std::int32_t tumour_label = 3;
  double tissue_boundary_factor = 1.0;    ///< spacing at boundaries between tissues / uniform spacing
  CellKind cells = CellKind::hexahedron;  ///< or tetrahedron; a body has no planar cells
  /// Hexahedra: cells a node (inside volume / cell volume / nodes). With eight points a cell that is six points a node.
  /// Where the nodes are finer the cells are split.
  double cells_per_node = 0.75;
  std::vector<std::int32_t> brain_labels = {1, 2, 3};  ///< labels of the label map that are tissue of the brain
  std::uint64_t seed = 1;
};

struct DiscretiseMeasures {
  std::size_t nodes = 0;
  std::size_t surface_nodes = 0;
  std::size_t removed_nodes = 0;  ///< left out because they were too near to another
  std::size_t cells = 0;
  std::size_t cut_cells = 0;
  std::size_t dropped_cells = 0;       ///< left out: cut hexahedra with a negligible inside part, flat tetrahedra
  double dropped_volume = 0;           ///< of those, mm³
  double spacing = 0;                  ///< the uniform spacing used, mm
  double mean_spacing = 0;             ///< the mean over the nodes of the one achieved, mm
  double smallest_distance_ratio = 0;  ///< least over nodes of distance to the nearest node / local spacing
  double surface_volume = 0;           ///< mm³
  double cells_inside_volume = 0;      ///< mm³
};

struct Discretisation {
  NodeCloud cloud;
  BackgroundCells cells;
  DiscretiseMeasures measures;
};

/// Fills a closed surface with nodes and background cells. The same input and seed give the same result bit for bit.
/// labels may be null: everything is tissue 1. The label of a node or cell is that of the nearest brain voxel when the
/// voxel it lies in is not of the brain. Throws std::invalid_argument on a surface that is open, self-intersecting or
/// inside out, options out of range, a spacing too coarse or too fine for the body, and labels that do not lie where
/// the surface does.
Discretisation discretise(const Surface& brain, const LabelMap* labels, const DiscretiseOptions& options,
                          const Progress& progress = {});

/// Writes nodes.vtu and cells.vtu into a folder that exists. Throws std::runtime_error, naming the file, when one
/// cannot be written whole.
void write_discretisation(const std::filesystem::path& folder, const Discretisation& discretisation);

}  // namespace brainshift::discretise
