// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "segmentation/surface/surface.hpp"

namespace brainshift {

/// The nodes: they carry mass and a parameter û each. All arrays have one entry a node, in the same order.
struct NodeCloud {
  Points positions;                      ///< undeformed, mm, LPS
  std::vector<double> spacing;           ///< local distance between nodes, mm, > 0
  std::vector<std::uint8_t> on_surface;  ///< 1 on the brain's surface
  std::vector<std::int32_t> label;       ///< tissue
  /// (n × 3) mm, NaN: that component is free. No rows when the cloud prescribes nothing.
  Points prescribed_displacement = Points(0, 3);
  /// (n × 3) N, acts at the node. No rows when there is none.
  Points force = Points(0, 3);

  std::size_t size() const { return static_cast<std::size_t>(positions.rows()); }
};

/// nodes.vtu: unstructured grid of one vertex cell a node, point arrays spacing, on_surface, label and, if any,
/// prescribed_displacement and force. On reading, spacing may be absent (then it is the mean distance to the six
/// nearest nodes), as may on_surface and label (then 0 and 1), and cells of other kinds are ignored: any mesh's points
/// serve as a cloud. Throws std::invalid_argument, naming file and node, on a file that is none, no node, a non-finite
/// coordinate, a spacing that is not positive, an array of the wrong size, or two nodes in one place.
NodeCloud read_node_cloud(const std::filesystem::path& file);
void write_node_cloud(const std::filesystem::path& file, const NodeCloud& cloud);

}  // namespace brainshift
