// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// The nodes: they carry mass and a parameter û each. All arrays have one entry a node, in the same order.
struct NodeCloud {
  Points positions;                      ///< undeformed, mm, LPS
  std::vector<double> spacing;           ///< local distance between nodes, mm, > 0
  std::vector<std::uint8_t> on_surface;  ///< 1 on the brain's surface

  std::size_t size() const { return static_cast<std::size_t>(positions.rows()); }
};

/// Throws std::invalid_argument, naming the node, where the arrays differ in length, there are less than two nodes, a
/// coordinate is not finite or a spacing not positive.
void check_nodes(const NodeCloud& cloud);

/// The nodes on the surface, ascending.
std::vector<std::int32_t> surface_nodes(const NodeCloud& cloud);

/// Mean over the nodes of their spacing, mm.
double mean_spacing(const NodeCloud& cloud);

/// Vectors at the nodes, (n × 3), under the name that they have in a file.
struct NodeVectors {
  const char* name;
  const Points& values;
};

/// nodes.vtu: unstructured grid of one vertex cell a node, point arrays spacing and on_surface. On reading, spacing may
/// be absent (then it is the mean distance to the six nearest nodes), as may on_surface (then 0), and cells of other
/// kinds are ignored: any mesh's points serve as a cloud. Throws std::invalid_argument, naming file and node, on a file
/// that is none, an array of the wrong size, two nodes in one place, and as check_nodes() does.
NodeCloud read_node_cloud(const std::filesystem::path& file);

/// Writes it, with more point arrays if wanted. Throws std::runtime_error, naming the file, when it cannot be written
/// whole.
void write_node_cloud(const std::filesystem::path& file, const NodeCloud& cloud,
                      std::span<const NodeVectors> vectors = {});

}  // namespace brainshift
