// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/patch_rim.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "solve/shape/support_search.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

namespace {

using std::numbers::pi;

constexpr double rim_reach = 1.8;              // spacings: sees the next ring of nodes all round
constexpr double open_angle = 140 * pi / 180;  // a patch's inner nodes leave less open, nodes on a straight rim 180°
constexpr double ahead_angle = pi / 3;         // free nodes so near to the middle of the opening lie beyond the rim
constexpr double smooth_turn = 0.5;            // sine of the angle by which the surface may turn on its way there
constexpr std::size_t fewest_inner = 2;        // nodes of the patch about one of its rim
constexpr double part_to_next = 0.5;           // of the way to the patch's next node inwards
constexpr double part_of_width = 0.4;          // of the way to its farthest node near by

bool is_held(const Points& prescribed, Eigen::Index node) {
  return prescribed.row(node).array().isFinite().all();
}

bool is_free(const Points& prescribed, Eigen::Index node) {
  return prescribed.row(node).array().isNaN().all();
}

/// A neighbour in the tangent plane.
struct Beside {
  Eigen::Vector2d way;  ///< mm
  double rise;          ///< out of the plane, mm

  bool smoothly() const { return std::abs(rise) < smooth_turn * std::hypot(way.norm(), rise); }
};

/// Widest range of directions without a neighbour: its middle and its width.
struct Gap {
  double middle, width;
};

Gap widest_gap(const std::vector<Beside>& neighbours) {
  std::vector<double> angle;
  for (const Beside& neighbour : neighbours) {
    angle.push_back(std::atan2(neighbour.way.y(), neighbour.way.x()));
  }
  std::sort(angle.begin(), angle.end());
  Gap widest{0, 0};
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const double next = i + 1 < angle.size() ? angle[i + 1] : angle[0] + 2 * pi;
    if (next - angle[i] > widest.width) {
      widest = {0.5 * (angle[i] + next), next - angle[i]};
    }
  }
  return widest;
}

/// Columns: two directions of the plane through a node and its neighbours, its normal. Absent where they lie on a line.
std::optional<Eigen::Matrix3d> tangent_axes(const Points& ways) {
  constexpr double on_a_line = 0.05;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(ways.transpose() * ways);
  if (spread.eigenvalues()[1] < on_a_line * spread.eigenvalues()[2]) {
    return std::nullopt;
  }
  return spread.eigenvectors().rowwise().reverse();
}

std::vector<Beside> in_axes(const Points& ways, const Eigen::Matrix3d& axes) {
  std::vector<Beside> result;
  const Points turned = ways * axes;
  for (const auto& way : turned.rowwise()) {
    result.push_back({way.head<2>(), way[2]});
  }
  return result;
}

/// A patch about one of its nodes, which lies on its rim.
struct AtRim {
  Eigen::RowVector3d outwards;     ///< unit
  std::vector<std::size_t> inner;  ///< the nodes of the patch near by that lie smoothly beside this one
};

/// Absent where the node is none of the rim. inner, outer: the ways to the nodes of the patch near by, and to free
/// ones.
std::optional<AtRim> at_rim(const Points& inner, const Points& outer) {
  std::optional<Eigen::Matrix3d> axes = tangent_axes(inner);
  if (!axes) {
    return std::nullopt;
  }
  AtRim found;
  const std::vector<Beside> all = in_axes(inner, *axes);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].smoothly()) {  // else of another face, or another bank of a fold
      found.inner.push_back(i);
    }
  }
  const Points smooth = inner(found.inner, Eigen::all);
  axes = found.inner.size() < fewest_inner ? std::nullopt : tangent_axes(smooth);
  if (!axes) {
    return std::nullopt;
  }
  std::vector<Beside> around = in_axes(smooth, *axes);
  const Gap gap = widest_gap(around);
  const Eigen::Vector2d middle(std::cos(gap.middle), std::sin(gap.middle));
  bool goes_on = false;
  for (const Beside& free : in_axes(outer, *axes)) {
    if (free.smoothly()) {
      around.push_back(free);
      goes_on = goes_on || free.way.dot(middle) > std::cos(ahead_angle) * free.way.norm();
    }
  }
  const bool at_edge = widest_gap(around).width > open_angle;
  if (gap.width < open_angle || !goes_on || at_edge) {
    return std::nullopt;
  }
  found.outwards = (axes->leftCols<2>() * middle).transpose();
  return found;
}

/// How far inside the condition goes, mm: places of opposite rims do not meet, nor comes one near the patch's next
/// node.
double inset(double spacing, const Points& inner, const Eigen::RowVector3d& outwards) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const auto& way : inner.rowwise()) {
    const double inwards = -way.dot(outwards);
    farthest = std::max(farthest, inwards);
    if (inwards > std::cos(ahead_angle) * way.norm()) {
      nearest = std::min(nearest, inwards);
    }
  }
  return std::min({rim_inset * spacing, part_to_next * nearest, part_of_width * farthest});
}

/// Surface nodes near a node, other than those in its place.
struct Near {
  std::vector<std::int32_t> held, free;
};

/// Finds the surface nodes about one.
class Surroundings {
 public:
  Surroundings(const NodeCloud& cloud, const Points& prescribed, std::span<const std::int32_t> fixed,
               const Visibility* visibility)
      : cloud_(cloud),
        prescribed_(prescribed),
        fixed_(fixed),
        visibility_(visibility),
        surface_(surface_nodes(cloud)),
        places_(cloud.positions(surface_, Eigen::all)),
        search_(places_, radii()) {}

  Near of(Eigen::Index node) const {
    std::vector<std::int32_t> found;
    search_.find(cloud_.positions.row(node), rim_reach, found);
    Near near;
    for (const std::int32_t s : found) {
      const std::int32_t b = surface_[static_cast<std::size_t>(s)];
      if (cloud_.positions.row(b) == cloud_.positions.row(node) || is_fixed(b) ||
          (visibility_ != nullptr && visibility_->detour(cloud_.positions.row(node), cloud_.positions.row(b)))) {
        continue;
      }
      if (is_held(prescribed_, b)) {
        near.held.push_back(b);
      } else if (is_free(prescribed_, b)) {
        near.free.push_back(b);
      }
    }
    return near;
  }

  bool is_fixed(std::int32_t node) const { return std::binary_search(fixed_.begin(), fixed_.end(), node); }
  const std::vector<std::int32_t>& surface() const { return surface_; }

 private:
  std::vector<double> radii() const {
    std::vector<double> radius;
    for (const std::int32_t a : surface_) {
      radius.push_back(cloud_.spacing[static_cast<std::size_t>(a)]);
    }
    return radius;
  }

  const NodeCloud& cloud_;
  const Points& prescribed_;
  std::span<const std::int32_t> fixed_;
  const Visibility* visibility_;
  std::vector<std::int32_t> surface_;
  Points places_;
  SupportSearch search_;
};

/// The values at a node and others about it, extended linearly by a way from the node: least squares of their slope.
void append_extension(std::int32_t node, std::vector<std::int32_t> others, const Points& ways_to_others,
                      const Eigen::RowVector3d& way, ShapeRows& extension) {
  constexpr double flat = 1e-6;  // singular values over the largest: the others lie in a plane
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> ways(ways_to_others.rows(), 3);
  ways.setThreshold(flat);
  ways.compute(ways_to_others);
  const Eigen::RowVectorXd shares = way * ways.pseudoInverse();
  std::vector<double> values(shares.begin(), shares.end());
  others.push_back(node);
  values.push_back(1 - shares.sum());
  extension.append({others, values, {}});
}

}  // namespace

PatchRim patch_rim(const NodeCloud& cloud, const Points& prescribed, std::span<const std::int32_t> fixed,
                   const Visibility* visibility) {
  PatchRim rim;
  const Surroundings surroundings(cloud, prescribed, fixed, visibility);
  std::vector<Eigen::RowVector3d> places;
  for (const std::int32_t a : surroundings.surface()) {
    if (!is_held(prescribed, a) || surroundings.is_fixed(a)) {
      continue;
    }
    const auto [held, free] = surroundings.of(a);
    if (held.size() < fewest_inner || free.empty()) {
      continue;
    }
    const Points inner = cloud.positions(held, Eigen::all).rowwise() - cloud.positions.row(a);
    const auto found = at_rim(inner, cloud.positions(free, Eigen::all).rowwise() - cloud.positions.row(a));
    if (found) {
      const Points smooth = inner(found->inner, Eigen::all);
      const double far = inset(cloud.spacing[static_cast<std::size_t>(a)], smooth, found->outwards);
      const Eigen::RowVector3d way = -far * found->outwards;
      std::vector<std::int32_t> others;
      for (const std::size_t i : found->inner) {
        others.push_back(held[i]);
      }
      rim.node.push_back(a);
      places.emplace_back(cloud.positions.row(a) + way);
      append_extension(a, std::move(others), smooth, way, rim.extension);
    }
  }
  rim.places = as_points(places);
  return rim;
}

}  // namespace brainshift::solve
