// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/merge_slivers.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::solve {

namespace {

constexpr double sliver = 0.1;        // of the full volume
constexpr double farthest_merge = 4;  // sides of a point's full volume: about two cells

/// The points of one tissue that are no slivers, to be found by place.
struct WholePoints {
  std::vector<std::int32_t> index;
  Points positions;
};

std::map<std::int32_t, WholePoints> whole_points_by_label(const IntegrationPoints& points,
                                                          const std::vector<std::uint8_t>& is_sliver) {
  std::map<std::int32_t, WholePoints> whole;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_sliver[i] == 0) {
      whole[points.label[i]].index.push_back(static_cast<std::int32_t>(i));
    }
  }
  for (auto& [label, of_label] : whole) {
    of_label.positions = points.positions(of_label.index, Eigen::all);
  }
  return whole;
}

std::vector<MergedPoint> keep(const std::vector<std::uint8_t>& dropped, const std::vector<std::uint8_t>& moved,
                              IntegrationPoints& points) {
  std::vector<MergedPoint> merged;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (dropped[i] == 0) {
      points.positions.row(static_cast<Eigen::Index>(kept)) = points.positions.row(static_cast<Eigen::Index>(i)).eval();
      points.volume[kept] = points.volume[i];
      points.cell[kept] = points.cell[i];
      points.label[kept] = points.label[i];
      merged.push_back({static_cast<std::int32_t>(i), moved[i] != 0});
      ++kept;
    }
  }
  points.positions.conservativeResize(static_cast<Eigen::Index>(kept), 3);
  points.volume.resize(kept);
  points.cell.resize(kept);
  points.label.resize(kept);
  return merged;
}

}  // namespace

std::vector<MergedPoint> merge_slivers(std::span<const double> full, IntegrationPoints& points) {
  std::vector<std::uint8_t> dropped(points.size(), 0), moved(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    dropped[i] = points.volume[i] < sliver * full[i] ? 1 : 0;
  }
  const std::map<std::int32_t, WholePoints> by_label = whole_points_by_label(points, dropped);
  for (std::size_t i = 0; i < points.size(); ++i) {
    dropped[i] = by_label.contains(points.label[i]) ? dropped[i] : std::uint8_t{0};  // all that its tissue has
  }
  const bool planar = points.positions.col(2).isZero(0);
  for (const auto& [label, whole] : by_label) {
    const PointTree tree(whole.positions);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (dropped[i] != 0 && points.label[i] == label) {
        const auto row = static_cast<Eigen::Index>(i);
        const auto [nearest, squared] = tree.nearest(points.positions.row(row).data());
        const double side = planar ? std::sqrt(full[i]) : std::cbrt(full[i]);
        if (squared > std::pow(farthest_merge * side, 2)) {
          dropped[i] = 0;
          continue;
        }
        const std::int32_t into = whole.index[nearest];
        double& volume = points.volume[static_cast<std::size_t>(into)];
        const double share = points.volume[i] / (points.volume[i] + volume);
        points.positions.row(into) += share * (points.positions.row(row) - points.positions.row(into));
        volume += points.volume[i];
        moved[static_cast<std::size_t>(into)] = 1;
      }
    }
  }
  return keep(dropped, moved, points);
}

}  // namespace brainshift::solve
