// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "segmentation/geometry/surface_tree.hpp"
#include "solve/arrays/shared_work.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/load/load_options.hpp"
#include "solve/load/noisy_load.hpp"
#include "solve/load/opening_shape.hpp"
#include "solve/load/openings.hpp"

namespace brainshift::solve {
namespace {

constexpr double apart = 0.5;  // mm, of places on the rim
constexpr int bisections = 20;

/// Without the points inside the brain.
CraniotomyLoad on_cortex(const Surface& brain, const CraniotomyLoad& load) {
  const SurfaceTree tree(brain);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    const Eigen::Vector3d x = load.positions.row(p);
    const SurfacePlace foot = tree.nearest(x);
    if ((foot.position - x).dot(foot.normal) <= cortex_depth) {
      kept.push_back(p);
    }
  }
  return rows_of(load, kept);
}

/// The place on an edge, one end of which lies beyond the rim.
Eigen::RowVector3d crossing(const OpeningShape& opening, Eigen::RowVector3d beyond, Eigen::RowVector3d within) {
  for (int round = 0; round < bisections; ++round) {
    const Eigen::RowVector3d middle = 0.5 * (beyond + within);
    (opening.beyond_rim(opening.local(middle)) > 0 ? beyond : within) = middle;
  }
  return within;
}

/// The places where the rim crosses the edges of a triangle, two or none.
std::vector<Eigen::RowVector3d> crossings(const OpeningShape& opening, const Points& vertices,
                                          std::span<const double> beyond, const Eigen::RowVector3i& corners) {
  std::vector<Eigen::RowVector3d> ends;
  for (int k = 0; k < 3; ++k) {
    int out = corners[k], in = corners[(k + 1) % 3];
    if (beyond[static_cast<std::size_t>(out)] <= 0) {
      std::swap(out, in);
    }
    if (beyond[static_cast<std::size_t>(out)] > 0 && beyond[static_cast<std::size_t>(in)] <= 0) {
      ends.push_back(crossing(opening, vertices.row(out), vertices.row(in)));
    }
  }
  return ends;
}

void append_line(const Eigen::RowVector3d& from, const Eigen::RowVector3d& to,
                 std::vector<Eigen::RowVector3d>& places) {
  const double pieces = std::ceil((to - from).norm() / apart);
  for (double k = 0; k <= pieces; ++k) {
    places.emplace_back(from + (pieces > 0 ? k / pieces : 0) * (to - from));
  }
}

std::vector<Eigen::RowVector3d> places_on_rim(const Surface& brain, const OpeningShape& opening, double depth) {
  const Points local = opening.local(brain.vertices);
  std::vector<double> beyond(static_cast<std::size_t>(local.rows()));
  share_work(local.rows(), places_a_part,
             [&](std::int64_t v) { beyond[static_cast<std::size_t>(v)] = opening.beyond_rim(local.row(v)); });
  std::vector<Eigen::RowVector3d> places;
  for (const auto& corners : brain.triangles.rowwise()) {
    const auto ends = crossings(opening, brain.vertices, beyond, corners);
    if (ends.size() == 2 && opening.displacement_at(opening.local(ends.front()), apart, depth)) {
      append_line(ends[0], ends[1], places);
    }
  }
  return places;
}

}  // namespace

Points opening_rim(const Surface& brain, const CraniotomyLoad& load, const OpeningOptions& options) {
  check_table(opening_options(), options);
  const CraniotomyLoad cortex = on_cortex(brain, load);
  if (cortex.positions.rows() == 0) {
    return Points(0, 3);
  }
  std::vector<Eigen::RowVector3d> places;
  for (const CraniotomyLoad& part : openings(cortex)) {
    if (const std::optional<double> margin = default_margin(part.positions)) {
      const OpeningShape opening(part, brain.vertices, options.margin >= 0 ? options.margin : *margin);
      const std::vector<Eigen::RowVector3d> rim = places_on_rim(brain, opening, options.depth);
      places.insert(places.end(), rim.begin(), rim.end());
    }
  }
  return as_points(places);
}

}  // namespace brainshift::solve
