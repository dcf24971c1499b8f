// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/geometry/triangle_tree.hpp"

namespace brainshift::solve {

/// The two walls of a rigid sheet of triangles, which may branch, be in pieces and face any way. A panel is one side of
/// a triangle: 2 t on the side of its normal, 2 t + 1 on the other. About an edge the next panel is the one that is met
/// first when going round through the tissue. So whoever walks from panel to panel stays on the side where it was.
class SheetWalls {
 public:
  /// A surface with at least one triangle, none without an area.
  explicit SheetWalls(const Surface& sheet);

  /// The panel of the nearest triangle on whose side x lies; on the triangle itself, that on the side of its normal.
  std::int32_t nearest_panel(const Eigen::Vector3d& x) const;

  struct Foot {
    double gap;              ///< mm from the wall, negative behind it
    Eigen::Vector3d normal;  ///< of the wall, a unit vector into the tissue
  };
  /// The foot of x on the wall, from a panel near by, which becomes the foot's. None beyond the rim of the sheet.
  std::optional<Foot> foot(const Eigen::Vector3d& x, std::int32_t& panel) const;

 private:
  struct Side {
    Eigen::Vector3d corner, outward;  ///< outward: in the triangle's plane, a unit vector
  };
  struct Facet {
    Eigen::Vector3d normal;
    std::array<Side, 3> sides;
  };

  std::int32_t next_about(std::int32_t panel, int side, const std::vector<std::pair<std::int32_t, int>>& around) const;
  Eigen::Vector3d wall_normal(std::int32_t panel) const;

  std::vector<Facet> facets_;
  std::vector<std::array<std::int32_t, 3>> next_;  ///< of each panel, beyond each side; none: -1
  TriangleTree tree_;
};

}  // namespace brainshift::solve
