// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/check_discretisation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/geometry/neighbour_distance.hpp"
#include "segmentation/geometry/quantile.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

namespace {

/// Nodes in nearly one place have nearly the same shape functions: their difference strains next to nothing, so it
/// comes to rest late or never.
void check_apart(const NodeCloud& cloud, const NearestNeighbours& near) {
  constexpr double least = 0.1;  // of the spacing
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    const std::size_t nearest = a * static_cast<std::size_t>(near.count);
    if (near.distance[nearest] < least * cloud.spacing[a]) {
      std::ostringstream text;
      text << "nodes " << a << " and " << near.index[nearest] << " lie only " << near.distance[nearest]
           << " mm apart, where the spacing is " << cloud.spacing[a] << " mm; remove one of them";
      throw std::invalid_argument(text.str());
    }
  }
}

/// Supports are as wide as `spacing` says: too small a value makes them grow until they hold nodes enough and no more,
/// too large a one smooths what the nodes could resolve. Layers and twins may lie near each other, so that only more
/// neighbours tell of the latter: their mean distance is 0.9 to 1.1 spacings in clouds of ours, however they are
/// graded.
void check_spacing(const NodeCloud& cloud, const NearestNeighbours& near) {
  constexpr double most = 2.5, most_in_part = 5, part = 0.1;  // distance to the nearest node over the spacing
  constexpr double least = 0.36;                              // mean distance to the six nearest over the spacing
  std::vector<double> nearest, mean = mean_neighbour_distance(near);
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    nearest.push_back(near.distance[a * static_cast<std::size_t>(near.count)] / cloud.spacing[a]);
    mean[a] /= cloud.spacing[a];
  }
  std::ostringstream text;
  if (const double typical = quantile(nearest, 0.5); typical > most) {
    text << "the nearest node is typically " << typical << " spacings away";
  } else if (const double far = quantile(nearest, 1 - part); far > most_in_part) {
    text << "of a tenth of the nodes the nearest is " << far << " spacings away or more";
  } else if (const double all = quantile(mean, 0.5); all < least) {
    text << "the six nearest nodes are typically only " << all << " spacings away";
  } else {
    return;
  }
  throw std::invalid_argument("the cloud's array 'spacing' does not fit its nodes: " + text.str() +
                              "; give the mean distance of neighbours, mm");
}

/// Motions that strain no point cost no energy. Measured on a pressed cube: with 0.7 points a node the force is right
/// to 4 %, with 0.5 to a quarter.
void check_number(std::size_t nodes, std::size_t points) {
  constexpr double least = 0.65;  // points a node
  if (static_cast<double>(points) < least * static_cast<double>(nodes)) {
    throw std::invalid_argument("only " + std::to_string(points) + " integration points for " + std::to_string(nodes) +
                                " nodes: motions between them would cost nothing; give smaller background cells or "
                                "more points a cell, at least one point a node");
  }
}

/// The same about each node: the points that see the node against the nodes in the support there. Returns the fewest
/// points a node about one inside.
double check_everywhere(const OrderedCloud& cloud, const ShapeRows& point_rows, const ShapeRows& nodal_rows) {
  constexpr double least = 0.3;
  std::vector<double> seen(cloud.size(), 0);
  for (const std::int32_t a : point_rows.node) {
    ++seen[static_cast<std::size_t>(a)];
  }
  double fewest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < seen.size(); ++a) {
    if (cloud.on_surface[a] == 0) {
      fewest = std::min(fewest, seen[a] / static_cast<double>(nodal_rows[a].size()));
    }
    if (seen[a] > 0 && seen[a] < least * static_cast<double>(nodal_rows[a].size())) {
      const auto x = cloud.positions.row(static_cast<Eigen::Index>(a));
      std::ostringstream text;
      text << "about the node at (" << x[0] << ", " << x[1] << ", " << x[2] << ") mm there are only " << seen[a]
           << " integration points for " << nodal_rows[a].size()
           << " nodes: motions between them would cost nothing; give smaller background cells there";
      throw std::invalid_argument(text.str());
    }
  }
  return fewest;
}

/// How far a place lies outside the box of the nodes, mm; negative inside.
double beyond(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& x) {
  return std::max((box.min() - x).maxCoeff(), (x - box.max()).maxCoeff());
}

/// Nodes lie on a body's surface, or half a spacing below it where they are the middles of cells. Cells a third larger
/// than the cloud would make tissue of what is around it, between corners that are still near a node.
void check_box(const OrderedCloud& cloud, const IntegrationPoints& points, const ShapeRows& point_rows) {
  constexpr double farthest = 0.6;  // spacings
  Eigen::AlignedBox3d box;
  for (const auto& x : cloud.positions.rowwise()) {
    box.extend(Eigen::Vector3d(x));
  }
  for (Eigen::Index p = 0; p < points.positions.rows(); ++p) {
    const Eigen::Vector3d x = points.positions.row(p);
    const double out = beyond(box, x);
    const auto is_near = [&](std::int32_t a) { return out <= farthest * cloud.spacing[static_cast<std::size_t>(a)]; };
    if (out > 0 && std::ranges::none_of(point_rows[static_cast<std::size_t>(p)].node, is_near)) {
      std::ostringstream text;
      text << "the background cells reach beyond the node cloud: an integration point at (" << x[0] << ", " << x[1]
           << ", " << x[2] << ") mm lies " << out << " mm outside the box of all nodes; make cells and cloud of the "
           << "same body";
      throw std::invalid_argument(text.str());
    }
  }
}

/// Supports grow until they reach the cloud: tissue where no node is would be invented.
void check_within(const OrderedCloud& cloud, const IntegrationPoints& points, const ShapeRows& point_rows) {
  constexpr double farthest = 1.5;  // from every node, of the node's spacing; of our clouds below 1
  const SupportSearch search(cloud.positions, cloud.spacing);
  std::vector<std::int32_t> near;
  std::size_t beyond = 0;
  Eigen::Index first = 0;
  for (Eigen::Index p = points.positions.rows(); p-- > 0;) {
    const Eigen::RowVector3d x = points.positions.row(p);
    const auto is_near = [&](std::int32_t a) {
      return (cloud.positions.row(a) - x).norm() < farthest * cloud.spacing[static_cast<std::size_t>(a)];
    };
    if (std::ranges::any_of(point_rows[static_cast<std::size_t>(p)].node, is_near)) {
      continue;
    }
    search.find(x, farthest, near);  // a cut may hide the near ones
    if (near.empty()) {
      ++beyond;
      first = p;
    }
  }
  if (beyond > 0) {
    const auto x = points.positions.row(first);
    std::ostringstream text;
    text << "the background cells reach beyond the node cloud: " << beyond << " of " << points.size()
         << " integration points lie over " << farthest << " spacings from every node, the first at (" << x[0] << ", "
         << x[1] << ", " << x[2] << ") mm; make cells and cloud of the same body";
    throw std::invalid_argument(text.str());
  }
}

}  // namespace

void check_cloud(const NodeCloud& cloud) {
  if (cloud.size() < 2) {
    return;
  }
  const NearestNeighbours near = nearest_neighbours(cloud.positions, 6);
  check_apart(cloud, near);
  check_spacing(cloud, near);
}

double check_points(const OrderedCloud& cloud, const IntegrationPoints& points, const ShapeRows& point_rows,
                    const ShapeRows& nodal_rows) {
  check_within(cloud, points, point_rows);
  check_box(cloud, points, point_rows);
  check_number(cloud.size(), points.size());
  return check_everywhere(cloud, point_rows, nodal_rows);
}

}  // namespace brainshift::solve
