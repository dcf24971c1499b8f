// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/shape_functions.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "segmentation/geometry/plane.hpp"
#include "solve/shape/evaluator.hpp"
#include "solve/shape/too_few_nodes.hpp"

namespace brainshift::solve {

namespace {

constexpr std::ptrdiff_t group = 128;  // points whose neighbours are searched together
constexpr Eigen::Index none = -1;

[[noreturn]] void throw_inadmissible(const Eigen::Vector3d& x, bool planar, bool cut) {
  std::ostringstream text;
  text << "no admissible support at the point (" << x[0] << ", " << x[1] << ", " << x[2]
       << ") mm: too few nodes near it, or all of them " << (planar ? "on one line" : "in one plane")
       << (cut ? "; a cut hides the others: move it, or give more nodes there" : "; add nodes or check their spacing");
  throw TooFewNodes(text.str());
}

/// Puts points that lie together beside each other, by halves of whole groups and of as many as there are lanes.
void gather(std::span<EvaluationPoint> points) {
  constexpr std::ptrdiff_t worth_a_task = 8192;
  const auto n = std::ssize(points);
  if (n <= lanes) {
    return;
  }
  Eigen::Vector3d low = points[0].at, high = low;
  for (const EvaluationPoint& p : points) {
    low = low.cwiseMin(p.at);
    high = high.cwiseMax(p.at);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::ptrdiff_t unit = n > group ? group : lanes, half = (n + unit) / (2 * unit) * unit;
  std::nth_element(points.begin(), points.begin() + half, points.end(),
                   [axis](const EvaluationPoint& a, const EvaluationPoint& b) { return a.at[axis] < b.at[axis]; });
#pragma omp task if (n > worth_a_task)
  gather(points.first(static_cast<std::size_t>(half)));
  gather(points.subspan(static_cast<std::size_t>(half)));
}

std::vector<EvaluationPoint> gathered(const Points& points) {
  std::vector<EvaluationPoint> places(static_cast<std::size_t>(points.rows()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = {points.row(static_cast<Eigen::Index>(i)), static_cast<std::int32_t>(i)};
  }
#pragma omp parallel
#pragma omp single
  gather(places);
  return places;
}

/// A point whose shape functions an evaluator has found, and where it keeps them.
struct Found {
  int lane;
  Eigen::Index point;
};

std::vector<Found> found_points(const Mask& mask, std::span<const EvaluationPoint> points) {
  std::vector<Found> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mask[i] != 0) {
      found.push_back({static_cast<int>(i), points[i].point});
    }
  }
  return found;
}

/// Takes a group of points. Returns one without a support, or none.
template <class Use>
Eigen::Index take(std::span<const EvaluationPoint> points, const NodeSupports& supports, Evaluator& evaluator,
                  const Use& use) {
  const Candidates near = candidates_near(supports, ball_about(points), 1);
  Eigen::Index fault = none;
  for (std::size_t i = 0; i < points.size(); i += lanes) {
    const std::span eight = points.subspan(i, std::min<std::size_t>(lanes, points.size() - i));
    const int bad =
        evaluator.move_to(eight, near, [&](const Mask& found) { use(evaluator, found_points(found, eight)); });
    fault = bad < 0 ? fault : eight[static_cast<std::size_t>(bad)].point;
  }
  return fault;
}

/// How far supports may grow, and whether each point must have one.
struct Reach {
  double largest_growth = 8;  // of the radii; beyond it the cloud is degenerate
  bool everywhere = true;
};

/// Calls use(evaluator, found points) for all gathered points that have a support; groups of them go to whichever
/// thread is free.
template <class Use>
void for_each_point(const NodeSupports& supports, std::span<const EvaluationPoint> points, const Reach& reach,
                    const Use& use) {
  std::atomic<Eigen::Index> bad = none;
#pragma omp parallel
  {
    Evaluator evaluator(supports, reach.largest_growth);
#pragma omp for schedule(dynamic)
    for (std::size_t i = 0; i < points.size(); i += group) {
      if (bad == none) {
        const Eigen::Index fault =
            take(points.subspan(i, std::min<std::size_t>(group, points.size() - i)), supports, evaluator, use);
        if (fault != none && reach.everywhere) {
          bad = fault;
        }
      }
    }
  }
  if (bad != none) {
    const auto of_it = [&](const EvaluationPoint& p) { return p.point == bad; };
    throw_inadmissible(std::find_if(points.begin(), points.end(), of_it)->at, supports.options.planar,
                       supports.visibility != nullptr);
  }
}

/// Rows with room for the support of each point, and nothing in it. Counting first costs less than rows that grow, in
/// time and in memory.
ShapeRows empty_rows(const NodeSupports& supports, std::span<const EvaluationPoint> points, const Reach& reach,
                     bool with_derivatives) {
  ShapeRows rows;
  rows.begin.assign(points.size() + 1, 0);
  std::atomic<std::size_t> grown = 0;
  for_each_point(supports, points, reach, [&](const Evaluator& at, std::span<const Found> found) {
    for (const auto& [lane, point] : found) {
      rows.begin[static_cast<std::size_t>(point) + 1] = at.support_size(lane);
    }
    grown += at.grown() ? found.size() : 0;
  });
  rows.grown = grown;
  std::partial_sum(rows.begin.begin(), rows.begin.end(), rows.begin.begin());
  const auto pairs = static_cast<std::size_t>(rows.begin.back());
  rows.node.resize(pairs);
  rows.value.resize(pairs);
  rows.derivative.resize(with_derivatives ? 3 * pairs : 0);
  return rows;
}

/// gradients: one a neighbour, or none.
void fill_rows(std::span<const Neighbour> neighbours, std::span<const ShapeGradient> gradients,
               std::span<const Found> found, ShapeRows& rows) {
  std::array<std::size_t, lanes> next;
  for (const auto& [lane, point] : found) {
    next[static_cast<std::size_t>(lane)] = static_cast<std::size_t>(rows.begin[static_cast<std::size_t>(point)]);
  }
  for (std::size_t a = 0; a < neighbours.size(); ++a) {
    for (const auto& [lane, point] : found) {
      if (!neighbours[a].supports(lane)) {
        continue;
      }
      const std::size_t k = next[static_cast<std::size_t>(lane)]++;
      rows.node[k] = neighbours[a].node;
      rows.value[k] = neighbours[a].value[lane];
      for (std::size_t axis = 0; axis < 3 && !gradients.empty(); ++axis) {
        rows.derivative[3 * k + axis] = gradients[a].axis[axis][lane];
      }
    }
  }
}

ShapeRows rows_of(const NodeSupports& supports, const Points& points, const Reach& reach, bool with_derivatives) {
  const std::vector<EvaluationPoint> places = gathered(points);
  ShapeRows rows = empty_rows(supports, places, reach, with_derivatives);
  for_each_point(supports, places, reach, [&](Evaluator& at, std::span<const Found> found) {
    fill_rows(at.neighbours(), with_derivatives ? at.gradients() : std::span<const ShapeGradient>(), found, rows);
  });
  return rows;
}

void check_plane(const Points& points, const ShapeOptions& options, const char* what) {
  if (!options.planar) {
    return;
  }
  if (const auto fault = off_plane(points, what)) {
    throw std::invalid_argument(*fault);
  }
}

}  // namespace

ShapeFunctions::ShapeFunctions(const Points& positions, std::span<const double> spacing, const ShapeOptions& options,
                               std::shared_ptr<const Visibility> visibility) {
  const Eigen::Index least = monomial_count(options.planar ? 2 : 3, options.basis == Basis::quadratic ? 2 : 1);
  if (positions.rows() < least) {
    throw std::invalid_argument("the cloud has " + std::to_string(positions.rows()) + " nodes, but this basis needs " +
                                std::to_string(least) + " in a support; add nodes");
  }
  check_plane(positions, options, "node");
  supports_ = std::make_shared<const NodeSupports>(positions, spacing, options, std::move(visibility));
}

std::size_t ShapeFunctions::nodes() const {
  return static_cast<std::size_t>(supports_->positions.rows());
}

ShapeRows ShapeFunctions::evaluate(const Points& points, bool with_derivatives) const {
  check_plane(points, supports_->options, "point");
  return rows_of(*supports_, points, {}, with_derivatives);
}

ShapeRows ShapeFunctions::evaluate_where_admissible(const Points& points, bool with_derivatives,
                                                    double largest_growth) const {
  check_plane(points, supports_->options, "point");
  return rows_of(*supports_, points, {largest_growth, false}, with_derivatives);
}

Points ShapeFunctions::interpolate(const Points& points, const Points& values) const {
  check_plane(points, supports_->options, "point");
  Points result(points.rows(), 3);
  for_each_point(*supports_, gathered(points), {}, [&](const Evaluator& at, std::span<const Found> found) {
    Lane sum[3];
    blend(at.neighbours(), values, sum);
    for (const auto& [lane, point] : found) {
      result.row(point) << sum[0][lane], sum[1][lane], sum[2][lane];
    }
  });
  return result;
}

}  // namespace brainshift::solve
