// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/shape_functions.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "discretise/plane.hpp"
#include "solve/shape/evaluator.hpp"

namespace brainshift::solve {

double dilatation(const ShapeOptions& options) {
  if (options.dilatation > 0) {
    return options.dilatation;
  }
  if (options.planar) {
    return options.basis == Basis::linear ? 1.8 : 2.4;
  }
  return options.basis == Basis::linear ? 1.6 : 2.2;
}

namespace {

constexpr Eigen::Index group = 128;           // points whose neighbours are searched together
constexpr Eigen::Index largest_chunk = 4096;  // points that one thread takes at a time
constexpr Eigen::Index none = -1;

[[noreturn]] void throw_inadmissible(const Points& points, Eigen::Index i, bool planar, bool cut) {
  std::ostringstream text;
  text << "no admissible support at the point (" << points(i, 0) << ", " << points(i, 1) << ", " << points(i, 2)
       << ") mm: too few nodes near it, or all of them " << (planar ? "on one line" : "in one plane")
       << (cut ? "; a cut hides the others: move it, or give more nodes there" : "; add nodes or check their spacing");
  throw std::invalid_argument(text.str());
}

/// Puts points that lie together beside each other, by halves of whole groups and of as many as there are lanes.
void gather(const Points& points, std::span<std::int32_t> order) {
  const auto n = static_cast<std::ptrdiff_t>(order.size());
  if (n <= lanes) {
    return;
  }
  Eigen::RowVector3d low = points.row(order[0]), high = low;
  for (const std::int32_t i : order) {
    low = low.cwiseMin(points.row(i));
    high = high.cwiseMax(points.row(i));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::ptrdiff_t unit = n > group ? group : lanes, half = (n + unit) / (2 * unit) * unit;
  std::nth_element(order.begin(), order.begin() + half, order.end(),
                   [&](std::int32_t a, std::int32_t b) { return points(a, axis) < points(b, axis); });
  gather(points, order.first(static_cast<std::size_t>(half)));
  gather(points, order.subspan(static_cast<std::size_t>(half)));
}

/// A point whose shape functions an evaluator has found, and where it keeps them.
struct Found {
  int lane;
  Eigen::Index point;
};

std::vector<Found> found_points(const Mask& mask, std::span<const std::int32_t> points, Eigen::Index before) {
  std::vector<Found> found;
  for (int lane = 0; lane < lanes; ++lane) {
    if (mask[lane] != 0) {
      found.push_back({lane, before + points[static_cast<std::size_t>(lane)]});
    }
  }
  return found;
}

/// Takes the points from..to in groups that lie together. Returns the first without a support, or none.
template <class Use>
Eigen::Index take(const Points& points, Eigen::Index from, Eigen::Index to, const ShapeFunctions::Impl& impl,
                  Evaluator& evaluator, const Use& use) {
  const Points part = points.middleRows(from, to - from);
  std::vector<std::int32_t> order(static_cast<std::size_t>(to - from));
  std::iota(order.begin(), order.end(), 0);
  gather(part, order);
  const Points ordered = part(order, Eigen::all);
  for (Eigen::Index i = 0; i < ordered.rows(); i += group) {
    const Eigen::Index end = std::min(i + group, ordered.rows());
    const Candidates near = candidates_near(impl, ball_about(ordered.middleRows(i, end - i)), 1);
    for (Eigen::Index first = i; first < end; first += lanes) {
      const std::span eight = std::span(order).subspan(static_cast<std::size_t>(first));
      const int bad = evaluator.move_to(ordered.middleRows(first, std::min<Eigen::Index>(lanes, end - first)), near,
                                        [&](const Mask& found) { use(found_points(found, eight, from)); });
      if (bad >= 0) {
        return from + eight[static_cast<std::size_t>(bad)];
      }
    }
  }
  return none;
}

/// Calls use(evaluator, found points) for all points, not in their order; chunks go to whichever thread is free.
template <class Use>
void for_each_point(const ShapeFunctions::Impl& impl, const Points& points, const Use& use) {
  const Eigen::Index chunk = std::clamp<Eigen::Index>(points.rows() / 32, group, largest_chunk);
  std::atomic<Eigen::Index> bad = none;
#pragma omp parallel
  {
    Evaluator evaluator(impl);
#pragma omp for schedule(dynamic)
    for (Eigen::Index from = 0; from < points.rows(); from += chunk) {
      if (bad == none) {
        const Eigen::Index fault = take(points, from, std::min(from + chunk, points.rows()), impl, evaluator,
                                        [&](std::span<const Found> found) { use(evaluator, found); });
        bad = fault != none ? fault : bad.load();
      }
    }
  }
  if (bad != none) {
    throw_inadmissible(points, bad, impl.options.planar, impl.visibility != nullptr);
  }
}

/// Rows with room for the support of each point, and nothing in it. Counting first costs less than rows that grow, in
/// time and in memory.
ShapeRows empty_rows(const ShapeFunctions::Impl& impl, const Points& points, bool with_derivatives) {
  ShapeRows rows;
  rows.begin.assign(static_cast<std::size_t>(points.rows()) + 1, 0);
  std::atomic<std::size_t> grown = 0;
  for_each_point(impl, points, [&](const Evaluator& at, std::span<const Found> found) {
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

/// slopes: one a sight, or none.
void fill_rows(std::span<const Sight> sights, std::span<const Slope> slopes, std::span<const Found> found,
               ShapeRows& rows) {
  std::array<std::size_t, lanes> next;
  for (const auto& [lane, point] : found) {
    next[static_cast<std::size_t>(lane)] = static_cast<std::size_t>(rows.begin[static_cast<std::size_t>(point)]);
  }
  for (std::size_t a = 0; a < sights.size(); ++a) {
    for (const auto& [lane, point] : found) {
      if (!sights[a].seen_from(lane)) {
        continue;
      }
      const std::size_t k = next[static_cast<std::size_t>(lane)]++;
      rows.node[k] = sights[a].node;
      rows.value[k] = sights[a].value[lane];
      for (std::size_t axis = 0; axis < 3 && !slopes.empty(); ++axis) {
        rows.derivative[3 * k + axis] = slopes[a].axis[axis][lane];
      }
    }
  }
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
  impl_ = std::make_shared<const Impl>(positions, spacing, options, std::move(visibility));
}

std::size_t ShapeFunctions::nodes() const {
  return static_cast<std::size_t>(impl_->positions.rows());
}

ShapeRows ShapeFunctions::evaluate(const Points& points, bool with_derivatives) const {
  check_plane(points, impl_->options, "point");
  ShapeRows rows = empty_rows(*impl_, points, with_derivatives);
  for_each_point(*impl_, points, [&](Evaluator& at, std::span<const Found> found) {
    fill_rows(at.sights(), with_derivatives ? at.slopes() : std::span<const Slope>(), found, rows);
  });
  return rows;
}

Points ShapeFunctions::interpolate(const Points& points, const Points& values) const {
  check_plane(points, impl_->options, "point");
  Points result(points.rows(), 3);
  for_each_point(*impl_, points, [&](const Evaluator& at, std::span<const Found> found) {
    Lane sum[3];
    blend(at.sights(), values, sum);
    for (const auto& [lane, point] : found) {
      result.row(point) << sum[0][lane], sum[1][lane], sum[2][lane];
    }
  });
  return result;
}

}  // namespace brainshift::solve
