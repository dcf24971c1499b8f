// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/adaptive_points.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>

#include "solve/quadrature/gauss_points.hpp"
#include "solve/quadrature/merge_slivers.hpp"
#include "solve/quadrature/split_cell.hpp"

namespace brainshift::solve {

namespace {

/// A part of a cell with its one point.
struct Region {
  std::int32_t cell;
  Corners corners;        ///< none: the inside part of an octant, which is not split
  std::int32_t cut = -1;  ///< row of cut_parts of a whole cut cell
  WeightedPoint point;
  double full;          ///< volume of the region, not of its inside part
  std::size_t level{};  ///< how often its cell was split
  std::size_t row{};    ///< of its shape functions, among those of its level
};

WeightedPoint one_point(CellKind kind, const Corners& corners) {
  std::vector<WeightedPoint> points;
  gauss_points(kind, corners, 1, points);
  return points.front();
}

std::vector<Region> whole_cells(const BackgroundCells& cells) {
  std::vector<Region> regions;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    Region region{static_cast<std::int32_t>(cell), corners_of(cells, cell), -1, {}, 0};
    region.point = one_point(cells.kind, region.corners);
    region.full = region.point.volume;
    region.point.volume *= cells.inside_fraction[cell];
    region.cut = cells.cut_index.empty() ? -1 : cells.cut_index[cell];
    if (region.cut >= 0) {
      region.point = inside_point(cells.cut_parts[static_cast<std::size_t>(region.cut)]);
    }
    regions.push_back(region);
  }
  return regions;
}

void append_parts(const BackgroundCells& cells, const Region& region, std::vector<Region>& out) {
  constexpr double nearly_whole = 1 - 1e-6;
  const double fraction = region.cut < 0 ? region.point.volume / region.full : 1;
  int octant = 0;
  for (const Corners& corners : split_cell(cells.kind, region.corners)) {
    Region part{region.cell, corners, -1, one_point(cells.kind, corners), 0};
    part.full = part.point.volume;
    part.point.volume *= fraction;
    if (region.cut >= 0) {
      const InsideOctants& inside = cells.cut_parts[static_cast<std::size_t>(region.cut)];
      const double volume = inside.volume[octant];
      if (volume < nearly_whole * part.full) {
        part.corners.resize(0, 3);
        part.point = {Eigen::Vector3d(inside.centroid[octant]), volume};
      }
    }
    ++octant;
    if (part.point.volume > 0) {
      out.push_back(part);
    }
  }
}

ShapeRows evaluate(const ShapeFunctions& shape, std::size_t level, std::vector<Region>& regions) {
  Points positions(static_cast<Eigen::Index>(regions.size()), 3);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    positions.row(static_cast<Eigen::Index>(i)) = regions[i].point.position;
    regions[i].level = level;
    regions[i].row = i;
  }
  return shape.evaluate(positions, true);
}

/// Σ w ∂φ_a/∂X over some regions, for one region and its parts after another; owned by one thread.
class Integral {
 public:
  explicit Integral(std::size_t nodes) : sum_(Points::Zero(static_cast<Eigen::Index>(nodes), 3)) {}

  void add(const ShapeRows& rows, const Region& region, double sign) {
    for (auto k = static_cast<std::size_t>(rows.begin[region.row]);
         k < static_cast<std::size_t>(rows.begin[region.row + 1]); ++k) {
      sum_.row(rows.node[k]) +=
          sign * region.point.volume * Eigen::Map<const Eigen::RowVector3d>(&rows.derivative[3 * k]);
      touched_.push_back(rows.node[k]);
    }
  }

  /// The squared norm; the next sum starts from 0.
  double take_squared_norm() {
    double total = 0;
    for (const std::int32_t node : touched_) {
      total += sum_.row(node).squaredNorm();
      sum_.row(node).setZero();  // a node may have been touched twice
    }
    touched_.clear();
    return total;
  }

 private:
  Points sum_;
  std::vector<std::int32_t> touched_;
};

/// 1 where the parts of a region integrate it to the tolerance. begin: where each region's parts begin, and an end.
std::vector<std::uint8_t> compare(const std::vector<Region>& regions, const ShapeRows& rows,
                                  const std::vector<Region>& parts, const ShapeRows& part_rows,
                                  std::span<const std::size_t> begin, std::size_t nodes, double tolerance) {
  std::vector<std::uint8_t> good(regions.size(), 0);
  const auto count = static_cast<std::int64_t>(regions.size());
#pragma omp parallel
  {
    Integral fine(nodes), difference(nodes);
#pragma omp for schedule(dynamic, 64)
    for (std::int64_t i = 0; i < count; ++i) {
      const auto region = static_cast<std::size_t>(i);
      difference.add(rows, regions[region], -1);
      for (std::size_t part = begin[region]; part < begin[region + 1]; ++part) {
        fine.add(part_rows, parts[part], 1);
        difference.add(part_rows, parts[part], 1);
      }
      const double error = difference.take_squared_norm(), whole = fine.take_squared_norm();
      good[region] = error <= tolerance * tolerance * whole ? 1 : 0;
    }
  }
  return good;
}

/// The regions that stay, and the shape functions of each level.
struct Kept {
  std::vector<Region> regions;
  std::vector<ShapeRows> rows;
  std::size_t capped = 0;
};

void check_affordable(std::size_t points, double tolerance, int depth) {
  constexpr std::size_t most = 3'000'000;  // some 6 kB each while they are placed
  if (points > most) {
    throw std::invalid_argument("adaptive integration to " + std::to_string(tolerance) + ", cells split " +
                                std::to_string(depth) + " times at most, takes " + std::to_string(points) +
                                " points, more than " + std::to_string(most) +
                                "; take a larger tolerance, a smaller depth or fewer cells");
  }
}

Kept refine(const BackgroundCells& cells, const ShapeFunctions& shape, double tolerance, int depth) {
  Kept kept;
  std::vector<Region> regions = whole_cells(cells);
  kept.rows.push_back(evaluate(shape, 0, regions));
  for (int split = 1; !regions.empty(); ++split) {
    std::vector<Region> parts, unfinished;
    std::vector<std::size_t> begin = {0};
    for (const Region& region : regions) {
      append_parts(cells, region, parts);
      begin.push_back(parts.size());
    }
    check_affordable(kept.regions.size() + parts.size(), tolerance, depth);
    kept.rows.push_back(evaluate(shape, kept.rows.size(), parts));
    const std::vector<std::uint8_t> good =
        compare(regions, kept.rows[kept.rows.size() - 2], parts, kept.rows.back(), begin, shape.nodes(), tolerance);
    for (std::size_t i = 0; i < good.size(); ++i) {
      for (std::size_t part = begin[i]; part < begin[i + 1]; ++part) {
        const bool ends = split == depth || parts[part].corners.rows() == 0;
        if (good[i] == 0 && !ends) {
          unfinished.push_back(parts[part]);
          continue;
        }
        kept.regions.push_back(parts[part]);
        kept.capped += good[i] == 0 ? 1 : 0;
      }
    }
    regions = std::move(unfinished);
  }
  return kept;
}

/// Row i of the result is row source[i].second of level source[i].first.
ShapeRows gather(const std::vector<ShapeRows>& levels, const std::vector<std::pair<std::size_t, std::size_t>>& source) {
  ShapeRows rows;
  rows.begin.push_back(0);
  for (const auto& [level, row] : source) {
    const ShapeRows& from = levels[level];
    const auto first = static_cast<std::ptrdiff_t>(from.begin[row]),
               last = static_cast<std::ptrdiff_t>(from.begin[row + 1]);
    rows.node.insert(rows.node.end(), from.node.begin() + first, from.node.begin() + last);
    rows.value.insert(rows.value.end(), from.value.begin() + first, from.value.begin() + last);
    rows.derivative.insert(rows.derivative.end(), from.derivative.begin() + 3 * first,
                           from.derivative.begin() + 3 * last);
    rows.begin.push_back(rows.begin.back() + last - first);
  }
  for (const ShapeRows& from : levels) {
    rows.grown += from.grown;
  }
  return rows;
}

void check(double tolerance, int depth) {
  if (!(tolerance > 0)) {
    throw std::invalid_argument("the integration tolerance is " + std::to_string(tolerance) + ", but must be above 0");
  }
  if (depth < 1 || depth > 6) {
    throw std::invalid_argument("the integration depth is " + std::to_string(depth) + ", but must be 1 to 6");
  }
}

}  // namespace

AdaptivePoints adaptive_points(const BackgroundCells& cells, const ShapeFunctions& shape, double tolerance, int depth,
                               const LabelMap* labels, const std::vector<std::int32_t>& tissues) {
  check(tolerance, depth);
  Kept kept = refine(cells, shape, tolerance, depth);
  std::stable_sort(kept.regions.begin(), kept.regions.end(),
                   [](const Region& a, const Region& b) { return a.cell < b.cell; });
  AdaptivePoints result;
  result.capped = kept.capped;
  result.points.positions.resize(static_cast<Eigen::Index>(kept.regions.size()), 3);
  std::vector<double> full;
  for (const Region& region : kept.regions) {
    result.points.positions.row(static_cast<Eigen::Index>(full.size())) = region.point.position;
    result.points.volume.push_back(region.point.volume);
    result.points.cell.push_back(region.cell);
    full.push_back(region.full);
  }
  take_tissues(cells, labels, tissues, result.points);
  const std::vector<MergedPoint> merged = merge_slivers(full, result.points);

  std::vector<std::pair<std::size_t, std::size_t>> source;
  std::vector<Eigen::Index> moved;
  for (std::size_t i = 0; i < merged.size(); ++i) {
    const Region& from = kept.regions[static_cast<std::size_t>(merged[i].from)];
    source.emplace_back(from.level, from.row);
    if (merged[i].moved) {
      source.back() = {kept.rows.size(), moved.size()};
      moved.push_back(static_cast<Eigen::Index>(i));
    }
  }
  kept.rows.push_back(shape.evaluate(result.points.positions(moved, Eigen::all), true));
  result.rows = gather(kept.rows, source);
  return result;
}

}  // namespace brainshift::solve
