// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/septum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/geometry/same_places.hpp"
#include "solve/arrays/shared_work.hpp"
#include "solve/cut/cut_facets.hpp"
#include "solve/cut/sheet_topology.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

Septum read_septum(const std::filesystem::path& file) {
  Septum septum{file.string(), read_surface(file)};
  join_at_same_places(septum.sheet.vertices, septum.sheet.triangles);
  check_septum(septum, false);
  return septum;
}

void check_septum(const Septum& septum, bool planar) {
  if (planar) {
    throw std::invalid_argument(septum.name + ": a septum is a sheet in space; leave it out of a plane problem");
  }
  if (septum.sheet.triangles.rows() == 0) {
    throw std::invalid_argument(septum.name + ": the septum has no triangle");
  }
  check_triangles(septum.sheet, septum.name);
}

CutFacets facets_of(const Septum& septum) {
  const Cut sheet{septum.name, septum.sheet.vertices, septum.sheet.triangles, {}};
  return facets_between(std::span(&sheet, 1), from_the_start, 0);
}

Points not_through(const Visibility& septum, const Points& measured, const NodeCloud& cloud, Points prescribed) {
  constexpr std::size_t most = 16;  // points that are looked at
  const PointTree points(measured);
  share_work(prescribed.rows(), places_a_part, [&](std::int64_t a) {
    if (prescribed.row(a).array().isNaN().all()) {
      return;
    }
    const Eigen::Vector3d x = cloud.positions.row(a);
    std::array<std::size_t, most> row{};
    std::array<double, most> squared{};
    const std::size_t found = points.nearest(x.data(), most, row.data(), squared.data());
    if (std::none_of(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(found), [&](std::size_t point) {
          return !septum.detour(x, measured.row(static_cast<Eigen::Index>(point)));
        })) {
      prescribed.row(a).setConstant(std::nan(""));
    }
  });
  return prescribed;
}

std::size_t moved_through(const Visibility& septum, const NodeCloud& cloud, const Points& prescribed) {
  std::size_t moved = 0;
  for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
    const Eigen::RowVector3d x = cloud.positions.row(a), u = prescribed.row(a);
    moved += u.allFinite() && septum.detour(x, x + u) ? 1 : 0;
  }
  return moved;
}

}  // namespace brainshift::solve
