// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/missing_octants.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "discretise/body/check_surface.hpp"
#include "discretise/body/scanlines.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/geometry/surface_tree.hpp"
#include "solve/quadrature/gauss_points.hpp"
#include "solve/quadrature/outline.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

namespace {

/// A place of a fine lattice in a cell.
struct LatticePlace {
  Eigen::Vector3d position;
  std::size_t octant;
};

std::vector<LatticePlace> lattice_of(const Corners& corners) {
  const bool solid = corners.rows() == 8;
  const int side = solid ? 8 : 16;  // places
  std::vector<LatticePlace> places;
  for (int i = 0; i < side * side * (solid ? side : 1); ++i) {
    const Eigen::Array3i at(i % side, i / side % side, solid ? i / (side * side) : 0);
    const Eigen::Array3i half = 2 * at / side;
    places.push_back({place_in(corners, (at.cast<double>() + 0.5) / side),
                      static_cast<std::size_t>(half[0] + 2 * half[1] + 4 * half[2])});
  }
  return places;
}

/// What lies inside the body, as far as it is known.
class KnownInside {
 public:
  KnownInside(const std::optional<Surface>& boundary, const NodeCloud& cloud, const BackgroundCells& cells)
      : cloud_(cloud) {
    if (boundary) {
      discretise::check_encloses_body(*boundary);
      surface_.emplace(*boundary);
      lines_.emplace(*boundary);
      return;
    }
    for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
      if (cloud.on_surface[static_cast<std::size_t>(a)] != 0) {
        nodes_.push_back(a);
      }
    }
    outline_ = is_planar(cells.kind) ? outline(cloud, cells) : outline_;
    places_ = cloud.positions(nodes_, Eigen::all);
    tree_.emplace(places_);
    search_.emplace(cloud.positions, cloud.spacing);
  }

  /// Takes away what of a cell's places is outside; at least one stays.
  void keep_inside(const Corners& corners, double fraction, std::vector<LatticePlace>& places) const {
    const Eigen::Vector3d middle = corners.colwise().mean();
    if (!is_known()) {
      const Eigen::Vector3d out = outward(middle);
      std::ranges::stable_sort(places, {}, [&](const LatticePlace& place) { return out.dot(place.position); });
      places.resize(static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(places.size()))));
      return;
    }
    std::erase_if(places, [&](const LatticePlace& place) { return !has(place.position); });
    if (places.empty()) {
      places.push_back({nearest(middle), 0});
    }
  }

  /// x, or of a concave part that it is the middle of the place nearest to it.
  Eigen::Vector3d inside(const Eigen::Vector3d& x, const std::vector<LatticePlace>& part) const {
    if (!is_known() || has(x)) {
      return x;
    }
    return std::ranges::min(part, {}, [&](const LatticePlace& place) { return (place.position - x).squaredNorm(); })
        .position;
  }

 private:
  bool is_known() const { return lines_ || !outline_.empty(); }
  bool has(const Eigen::Vector3d& x) const {
    return lines_ ? lines_->inside(x) : is_within(cloud_.positions, outline_, x);
  }
  Eigen::Vector3d nearest(const Eigen::Vector3d& x) const {
    return surface_ ? surface_->nearest(x).position
                    : Eigen::Vector3d(places_.row(static_cast<Eigen::Index>(tree_->nearest(x.data()).first)));
  }

  Eigen::Vector3d outward(const Eigen::Vector3d& x) const {
    constexpr double within = 2;  // spacings
    const Eigen::Index node = nodes_[tree_->nearest(x.data()).first];
    const Eigen::Vector3d at = cloud_.positions.row(node);
    std::vector<std::int32_t> near;
    search_->find(at, within, near);
    return at - cloud_.positions(near, Eigen::all).colwise().mean().transpose();
  }

  const NodeCloud& cloud_;
  std::optional<SurfaceTree> surface_;
  std::optional<discretise::Scanlines> lines_;
  std::vector<std::array<std::int32_t, 2>> outline_;  // in the plane
  std::vector<Eigen::Index> nodes_;                   // on the surface
  Points places_;                                     // of these
  std::optional<PointTree> tree_;
  std::optional<SupportSearch> search_;
};

InsideOctants octants_of(const KnownInside& body, const Corners& corners, double fraction, double volume) {
  std::vector<LatticePlace> places = lattice_of(corners);
  body.keep_inside(corners, fraction, places);
  InsideOctants octants{};
  for (std::size_t octant = 0; octant < 8; ++octant) {
    std::vector<LatticePlace> part;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const LatticePlace& place : places) {
      if (place.octant == octant) {
        part.push_back(place);
        sum += place.position;
      }
    }
    if (!part.empty()) {
      const auto count = static_cast<double>(part.size());
      octants.volume[octant] = fraction * volume * count / static_cast<double>(places.size());
      Eigen::Map<Eigen::Vector3d>(octants.centroid[octant]) = body.inside(sum / count, part);
    }
  }
  return octants;
}

double volume_of(CellKind kind, const Corners& corners) {
  std::vector<WeightedPoint> points;
  gauss_points(kind, corners, static_cast<int>(corners.rows()), points);
  double volume = 0;
  for (const WeightedPoint& point : points) {
    volume += point.volume;
  }
  return volume;
}

std::vector<std::size_t> cells_without_octants(const BackgroundCells& cells) {
  std::vector<std::size_t> missing;
  const bool may_be_cut = cells.kind == CellKind::hexahedron || cells.kind == CellKind::quadrilateral;
  for (std::size_t cell = 0; may_be_cut && cell < cells.size(); ++cell) {
    if (cells.inside_fraction[cell] < 1 && (cells.cut_index.empty() || cells.cut_index[cell] < 0)) {
      missing.push_back(cell);
    }
  }
  return missing;
}

}  // namespace

std::optional<BackgroundCells> with_missing_octants(const BackgroundCells& given,
                                                    const std::optional<Surface>& boundary, const NodeCloud& cloud) {
  const std::vector<std::size_t> missing = cells_without_octants(given);
  const bool by_surface = boundary && !is_planar(given.kind);
  const bool by_nodes = std::ranges::find(cloud.on_surface, 1) != cloud.on_surface.end();
  if (missing.empty() || !(by_surface || by_nodes)) {
    return std::nullopt;
  }
  const KnownInside body(by_surface ? boundary : std::nullopt, cloud, given);
  BackgroundCells cells = given;
  cells.cut_index.resize(cells.size(), -1);
  const std::size_t first = cells.cut_parts.size();
  cells.cut_parts.resize(first + missing.size());
#pragma omp parallel for schedule(dynamic, 16)
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const std::size_t cell = missing[i];
    const Corners corners = corners_of(cells, cell);
    cells.cut_parts[first + i] = octants_of(body, corners, cells.inside_fraction[cell], volume_of(cells.kind, corners));
    cells.cut_index[cell] = static_cast<std::int32_t>(first + i);
  }
  return cells;
}

}  // namespace brainshift::solve
