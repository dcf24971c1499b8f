// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/geometry/triangle_distance.hpp"
#include "segmentation/geometry/triangle_tree.hpp"

namespace brainshift::solve {

/// The two walls of a rigid sheet of triangles, which may branch, be in pieces and face any way. A panel is one side of
/// a triangle: 2 t on the side of its normal, 2 t + 1 on the other. About an edge the next panel is the one that is met
/// first when going round through the tissue. So whoever walks from panel to panel stays on the side where it was.
class SheetWalls {
 public:
  /// A surface with at least one triangle, none without an area.
  explicit SheetWalls(const Surface& sheet);

  /// The panel of the nearest triangle on whose side x lies; on the sheet itself, that on the side of its normal.
  std::int32_t nearest_panel(const Eigen::Vector3d& x) const;

  struct Foot {
    double gap;              ///< mm from the wall, negative behind it
    Eigen::Vector3d normal;  ///< of the wall there, a unit vector into the tissue
    Eigen::Vector3d place;
  };
  /// The place of the wall nearest to x, going downhill from a panel near by, which becomes the foot's. None beyond the
  /// rim of the sheet.
  std::optional<Foot> foot(const Eigen::Vector3d& x, std::int32_t& panel) const;

  /// The edges of the sheet that one triangle alone has, by their ends.
  std::vector<std::array<Eigen::Vector3d, 2>> rim() const;

 private:
  /// Side i of a triangle goes from its corner i to the next.
  using Sides = std::vector<std::pair<std::int32_t, std::size_t>>;
  struct Facet {
    TriangleFrame frame;
    Eigen::Vector3d normal;
    std::array<Eigen::Vector3d, 3> inward;  ///< from each side, in the triangle's plane, unit vectors
  };

  std::int32_t next_about(std::int32_t panel, std::size_t side, const Sides& around) const;
  const Facet& facet(std::int32_t panel) const { return facets_[static_cast<std::size_t>(panel / 2)]; }
  std::int32_t next(std::int32_t panel, std::size_t side) const { return next_[static_cast<std::size_t>(panel)][side]; }
  Eigen::Vector3d wall_normal(std::int32_t panel) const;

  std::vector<Facet> facets_;
  std::vector<std::array<std::int32_t, 3>> next_;  ///< of each panel, beyond each side; none: -1
  TriangleTree tree_;
};

}  // namespace brainshift::solve
