// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/adaptive_points.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>

#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/gauss_points.hpp"
#include "solve/quadrature/merge_slivers.hpp"
#include "solve/quadrature/place_points.hpp"
#include "solve/quadrature/split_cell.hpp"

namespace brainshift::solve {

namespace {

WeightedPoint one_point(CellKind kind, const Corners& corners) {
  std::vector<WeightedPoint> points;
  gauss_points(kind, corners, 1, points);
  return points.front();
}

/// A cell or a part of one, with its points.
struct CellPart {
  std::int32_t cell;
  Corners corners;              ///< none: the inside part of an octant, which is not split
  double fraction;              ///< of its volume that is inside
  std::int32_t cut = -1;        ///< row of cut_parts of a whole cut cell
  std::size_t first{}, last{};  ///< its points, among those of its level
};

/// Regions that were split equally often.
struct Level {
  std::vector<CellPart> regions;
  std::vector<WeightedPoint> points;
  std::vector<double> full;  ///< volume that each point would have if its cell were not cut
  ShapeRows rows;            ///< one a point

  void add(CellPart region, const WeightedPoint& point, double volume) {
    region.first = points.size();
    points.push_back(point);
    full.push_back(volume);
    region.last = points.size();
    regions.push_back(region);
  }

  void add(CellPart region, CellKind kind, int count) {
    region.first = points.size();
    gauss_points(kind, region.corners, count, points);
    region.last = points.size();
    for (std::size_t i = region.first; i < region.last; ++i) {
      full.push_back(points[i].volume);
      points[i].volume *= region.fraction;
    }
    regions.push_back(region);
  }

  void evaluate(const ShapeFunctions& shape) {
    Points positions(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
      positions.row(static_cast<Eigen::Index>(i)) = points[i].position;
    }
    rows = shape.evaluate(positions, true);
  }
};

Level whole_cells(const BackgroundCells& cells, std::size_t from, std::size_t to, int count) {
  Level level;
  for (std::size_t cell = from; cell < to; ++cell) {
    CellPart region{static_cast<std::int32_t>(cell), corners_of(cells, cell), cells.inside_fraction[cell]};
    region.cut = cells.cut_index.empty() ? -1 : cells.cut_index[cell];
    if (region.cut >= 0) {
      level.add(region, inside_point(cells.cut_parts[static_cast<std::size_t>(region.cut)]), 0);
    } else {
      level.add(region, cells.kind, count);
    }
  }
  return level;
}

void append_parts(const BackgroundCells& cells, const CellPart& region, int count, Level& out) {
  constexpr double nearly_whole = 1 - 1e-6;
  int octant = 0;
  for (const Corners& corners : split_cell(cells.kind, region.corners)) {
    if (region.cut < 0) {
      out.add({region.cell, corners, region.fraction}, cells.kind, count);
      continue;
    }
    const InsideOctants& inside = cells.cut_parts[static_cast<std::size_t>(region.cut)];
    const double volume = inside.volume[octant], whole = one_point(cells.kind, corners).volume;
    if (volume >= nearly_whole * whole) {
      out.add({region.cell, corners, 1}, cells.kind, count);
    } else if (volume > 0) {
      out.add({region.cell, Corners(0, 3), 1}, {Eigen::Vector3d(inside.centroid[octant]), volume}, whole);
    }
    ++octant;
  }
}

/// Σ w ∂φ_a/∂X over some regions, for one region and its parts after another; owned by one thread.
class Integral {
 public:
  explicit Integral(std::size_t nodes) : sum_(Points::Zero(static_cast<Eigen::Index>(nodes), 3)) {}

  void add(const Level& level, const CellPart& region, double sign) {
    for (std::size_t i = region.first; i < region.last; ++i) {
      const ShapeRow row = level.rows[i];
      for (std::size_t k = 0; k < row.size(); ++k) {
        sum_.row(row.node[k]) += sign * level.points[i].volume * row.gradient(k).transpose();
        touched_.push_back(row.node[k]);
      }
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
std::vector<std::uint8_t> compare(const Level& whole, const Level& parts, std::span<const std::size_t> begin,
                                  std::size_t nodes, double tolerance) {
  std::vector<std::uint8_t> good(whole.regions.size(), 0);
  const auto count = static_cast<std::int64_t>(good.size());
#pragma omp parallel
  {
    Integral fine(nodes), difference(nodes);
#pragma omp for schedule(dynamic, 64)
    for (std::int64_t i = 0; i < count; ++i) {
      const auto region = static_cast<std::size_t>(i);
      difference.add(whole, whole.regions[region], -1);
      for (std::size_t part = begin[region]; part < begin[region + 1]; ++part) {
        fine.add(parts, parts.regions[part], 1);
        difference.add(parts, parts.regions[part], 1);
      }
      const double error = difference.take_squared_norm(), norm = fine.take_squared_norm();
      good[region] = error <= tolerance * tolerance * norm ? 1 : 0;
    }
  }
  return good;
}

void reserve(std::size_t points, std::size_t pairs, ShapeRows& rows) {
  rows.begin.reserve(points + 1);
  rows.node.reserve(pairs);
  rows.value.reserve(pairs);
  rows.derivative.reserve(3 * pairs);
  rows.begin.assign(1, 0);
}

/// The points of some cells, in their order.
struct Placed {
  std::vector<WeightedPoint> points;
  std::vector<std::int32_t> cell;
  std::vector<double> full;
  ShapeRows rows;
  std::size_t capped = 0;
};

void check_affordable(std::size_t points, const AdaptiveRule& rule) {
  constexpr std::size_t most = 3'000'000;
  if (points > most) {
    throw std::invalid_argument("adaptive integration to " + std::to_string(rule.tolerance) + ", cells split " +
                                std::to_string(rule.depth) + " times at most, takes more than " + std::to_string(most) +
                                " points; take a larger tolerance, a smaller depth or fewer cells");
  }
}

/// No fewer points than these: those of cells that are whole, split once.
std::size_t fewest_points(const BackgroundCells& cells, const AdaptiveRule& rule) {
  const std::size_t parts = is_planar(cells.kind) ? 4 : 8;
  return (cells.size() - cells.cut_parts.size()) * parts * static_cast<std::size_t>(rule.points_per_part);
}

/// A point that is kept, and the level that it comes from.
struct Source {
  std::int32_t cell;
  std::size_t level, point;
};

/// Cells as they were split: what is kept of each level.
struct Refined {
  std::vector<Level> levels;
  std::vector<Source> sources;
  std::size_t capped = 0;
};

/// Keeps the parts that are good enough, or that are not split again; the others are the next level's regions.
void keep_parts(const std::vector<std::uint8_t>& good, std::span<const std::size_t> begin, bool deepest, Level& parts,
                Refined& out) {
  std::vector<CellPart> unfinished;
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (std::size_t part = begin[i]; part < begin[i + 1]; ++part) {
      const CellPart& region = parts.regions[part];
      if (good[i] == 0 && !deepest && region.corners.rows() > 0) {
        unfinished.push_back(region);
        continue;
      }
      for (std::size_t point = region.first; point < region.last; ++point) {
        out.sources.push_back({region.cell, out.levels.size(), point});
        out.capped += good[i] == 0 ? 1 : 0;
      }
    }
  }
  parts.regions = std::move(unfinished);
}

/// Splits the cells from..to. before: points of the cells before these.
Refined refine(const BackgroundCells& cells, std::size_t from, std::size_t to, const ShapeFunctions& shape,
               const AdaptiveRule& rule, std::size_t before) {
  Refined refined;
  refined.levels.push_back(whole_cells(cells, from, to, rule.points_per_part));
  refined.levels.back().evaluate(shape);
  while (!refined.levels.back().regions.empty()) {
    const Level& whole = refined.levels.back();
    Level parts;
    std::vector<std::size_t> begin = {0};
    for (const CellPart& region : whole.regions) {
      append_parts(cells, region, rule.points_per_part, parts);
      begin.push_back(parts.regions.size());
    }
    check_affordable(before + refined.sources.size() + parts.points.size(), rule);
    parts.evaluate(shape);
    const std::vector<std::uint8_t> good = compare(whole, parts, begin, shape.nodes(), rule.tolerance);
    const bool deepest = refined.levels.size() == static_cast<std::size_t>(rule.depth);
    keep_parts(good, begin, deepest, parts, refined);
    refined.levels.push_back(std::move(parts));
  }
  return refined;
}

/// The kept points, cell by cell, those of a cell by level.
Placed collect(Refined refined) {
  auto& [levels, sources, capped] = refined;
  Placed placed;
  placed.capped = capped;
  std::stable_sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) { return a.cell < b.cell; });
  std::size_t pairs = 0;
  for (const Source& s : sources) {
    pairs += levels[s.level].rows[s.point].size();
  }
  reserve(sources.size(), pairs, placed.rows);
  for (const Level& level : levels) {
    placed.rows.grown += level.rows.grown;
  }
  for (const Source& s : sources) {
    const Level& level = levels[s.level];
    placed.points.push_back(level.points[s.point]);
    placed.full.push_back(level.full[s.point]);
    placed.cell.push_back(s.cell);
    placed.rows.append(level.rows[s.point]);
  }
  return placed;
}

/// The rows of the points that are left, those of the moved ones new. Gives the batches' memory back as it goes.
ShapeRows gather(std::vector<ShapeRows> batches, const std::vector<MergedPoint>& merged, const ShapeRows& moved) {
  ShapeRows rows;
  std::size_t pairs = moved.node.size();
  for (const ShapeRows& batch : batches) {
    pairs += batch.node.size();
    rows.grown += batch.grown;
  }
  rows.grown += moved.grown;
  reserve(merged.size(), pairs, rows);
  std::size_t batch = 0, before = 0, next_moved = 0;
  for (const MergedPoint& m : merged) {
    while (static_cast<std::size_t>(m.from) >= before + batches[batch].size()) {
      before += batches[batch].size();
      batches[batch++] = {};
    }
    if (m.moved) {
      rows.append(moved[next_moved++]);
    } else {
      rows.append(batches[batch][static_cast<std::size_t>(m.from) - before]);
    }
  }
  return rows;
}

}  // namespace

AdaptivePoints adaptive_points(const BackgroundCells& cells, const ShapeFunctions& shape, const AdaptiveRule& rule,
                               const LabelMap* labels, const std::vector<std::int32_t>& tissues) {
  check_points_per_cell(cells.kind, rule.points_per_part);
  check_affordable(fewest_points(cells, rule), rule);
  constexpr std::size_t cells_per_batch = 256;  // of which the rows of all levels are in memory
  AdaptivePoints result;
  std::vector<WeightedPoint> points;
  std::vector<double> full;
  std::vector<ShapeRows> batches;
  for (std::size_t from = 0; from < cells.size(); from += cells_per_batch) {
    const std::size_t to = std::min(from + cells_per_batch, cells.size());
    Placed batch = collect(refine(cells, from, to, shape, rule, points.size()));
    points.insert(points.end(), batch.points.begin(), batch.points.end());
    full.insert(full.end(), batch.full.begin(), batch.full.end());
    result.points.cell.insert(result.points.cell.end(), batch.cell.begin(), batch.cell.end());
    result.capped += batch.capped;
    batches.push_back(std::move(batch.rows));
  }
  place_points(points, result.points);
  take_tissues(cells, labels, tissues, result.points);
  const std::vector<MergedPoint> merged = merge_slivers(full, result.points);
  std::vector<Eigen::Index> moved;
  for (std::size_t i = 0; i < merged.size(); ++i) {
    if (merged[i].moved) {
      moved.push_back(static_cast<Eigen::Index>(i));
    }
  }
  result.rows = gather(std::move(batches), merged, shape.evaluate(result.points.positions(moved, Eigen::all), true));
  return result;
}

}  // namespace brainshift::solve
