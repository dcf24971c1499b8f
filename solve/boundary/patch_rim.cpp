// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/patch_rim.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "solve/cut/touched_rows.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

namespace {

using std::numbers::pi;

constexpr double rim_reach = 1.8;              // spacings: sees the next ring of nodes all round
constexpr double open_angle = 140 * pi / 180;  // a patch's inner nodes leave less open, nodes on a straight rim 180°
constexpr double ahead = pi / 3;               // free nodes so near to the middle of the opening lie beyond the rim
constexpr double smooth_turn = 0.5;            // sine of the angle by which the surface may turn on its way there
constexpr std::size_t fewest_inner = 2;        // nodes of the patch about one of its rim

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

/// The unit vector out of the patch at a node of its rim, absent at others. inner, outer: the ways to the nodes of the
/// patch near by, and to free ones.
std::optional<Eigen::RowVector3d> out_of_patch(const Points& inner, const Points& outer) {
  const std::optional<Eigen::Matrix3d> axes = tangent_axes(inner);
  if (!axes) {
    return std::nullopt;
  }
  std::vector<Beside> around = in_axes(inner, *axes);
  const Gap gap = widest_gap(around);
  const Eigen::Vector2d middle(std::cos(gap.middle), std::sin(gap.middle));
  bool goes_on = false;
  for (const Beside& free : in_axes(outer, *axes)) {
    if (free.smoothly()) {
      around.push_back(free);
      goes_on = goes_on || free.way.dot(middle) > std::cos(ahead) * free.way.norm();
    }
  }
  const bool at_edge = widest_gap(around).width > open_angle;
  if (gap.width < open_angle || !goes_on || at_edge) {
    return std::nullopt;
  }
  return (axes->leftCols<2>() * middle).transpose();
}

/// Surface nodes near a node, other than those in its place.
struct Near {
  std::vector<std::int32_t> held, free;
};

/// Finds the surface nodes about one.
class Surroundings {
 public:
  Surroundings(const Points& positions, std::span<const double> spacing, std::vector<std::int32_t> surface,
               const Points& prescribed)
      : positions_(positions),
        prescribed_(prescribed),
        surface_(std::move(surface)),
        places_(positions(surface_, Eigen::all)),
        search_(places_, radii(spacing)) {}

  Near of(Eigen::Index node) const {
    std::vector<std::int32_t> found;
    search_.find(positions_.row(node), rim_reach, found);
    Near near;
    for (const std::int32_t s : found) {
      const std::int32_t b = surface_[static_cast<std::size_t>(s)];
      const bool elsewhere = positions_.row(b) != positions_.row(node);
      if (elsewhere && is_held(prescribed_, b)) {
        near.held.push_back(b);
      } else if (elsewhere && is_free(prescribed_, b)) {
        near.free.push_back(b);
      }
    }
    return near;
  }

 private:
  std::vector<double> radii(std::span<const double> spacing) const {
    std::vector<double> radius;
    for (const std::int32_t a : surface_) {
      radius.push_back(spacing[static_cast<std::size_t>(a)]);
    }
    return radius;
  }

  const Points& positions_;
  const Points& prescribed_;
  std::vector<std::int32_t> surface_;
  Points places_;
  SupportSearch search_;
};

std::vector<std::int32_t> on_surface_nodes(std::span<const std::uint8_t> on_surface) {
  std::vector<std::int32_t> nodes;
  for (std::size_t a = 0; a < on_surface.size(); ++a) {
    if (on_surface[a] != 0) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

Points stacked(const std::vector<Eigen::RowVector3d>& rows) {
  Points points(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = rows[i];
  }
  return points;
}

}  // namespace

PatchRim patch_rim(const Points& positions, std::span<const double> spacing, std::span<const std::uint8_t> on_surface,
                   const Points& prescribed, std::span<const std::int32_t> fixed, const ShapeFunctions& shape) {
  const std::vector<std::int32_t> surface = on_surface_nodes(on_surface);
  const auto any = [&](const auto& is) {
    return std::any_of(surface.begin(), surface.end(), [&](std::int32_t a) { return is(prescribed, a); });
  };
  PatchRim rim;
  if (!any(is_held) || !any(is_free)) {
    return rim;
  }
  const Surroundings surroundings(positions, spacing, surface, prescribed);
  std::vector<Eigen::RowVector3d> places, values;
  for (const std::int32_t a : surface) {
    if (!is_held(prescribed, a) || std::binary_search(fixed.begin(), fixed.end(), a)) {
      continue;
    }
    const auto [held, free] = surroundings.of(a);
    if (held.size() < fewest_inner || free.empty()) {
      continue;
    }
    const Points inner = positions(held, Eigen::all).rowwise() - positions.row(a);
    const auto outwards = out_of_patch(inner, positions(free, Eigen::all).rowwise() - positions.row(a));
    if (outwards) {
      const Eigen::RowVector3d way = -rim_inset * spacing[static_cast<std::size_t>(a)] * *outwards;
      const Points changes = prescribed(held, Eigen::all).rowwise() - prescribed.row(a);
      rim.node.push_back(a);
      places.emplace_back(positions.row(a) + way);
      values.emplace_back(prescribed.row(a) + way * inner.completeOrthogonalDecomposition().solve(changes));
    }
  }
  rim.prescribed = stacked(values);
  rim.rows = shape.evaluate(stacked(places), false);
  return rim;
}

ShapeRows rows_of_conditions(const ShapeRows& nodal_rows, const PatchRim& rim) {
  return rim.node.empty() ? nodal_rows : with_rows(nodal_rows, rim.node, rim.rows);
}

Points prescribed_of_conditions(const Points& prescribed, const PatchRim& rim) {
  Points result = prescribed;
  for (std::size_t i = 0; i < rim.node.size(); ++i) {
    result.row(rim.node[i]) = rim.prescribed.row(static_cast<Eigen::Index>(i));
  }
  return result;
}

}  // namespace brainshift::solve
