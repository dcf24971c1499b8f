// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/near_surface.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/geometry/quantile.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::solve {
namespace {

struct Distances {
  double median = 0;
  double farthest = 0;
  Eigen::Index farthest_row = 0;
};

Distances distances_to(const PointTree& surface, const Points& measured) {
  Distances result;
  std::vector<double> distances;
  for (Eigen::Index p = 0; p < measured.rows(); ++p) {
    const Eigen::RowVector3d place = measured.row(p);
    distances.push_back(std::sqrt(surface.nearest(place.data()).second));
    if (distances.back() > result.farthest) {
      result.farthest = distances.back();
      result.farthest_row = p;
    }
  }
  result.median = median(std::move(distances));
  return result;
}

/// Of the points with x and y turned.
Distances distances_when_turned(const PointTree& surface, Points measured) {
  measured.leftCols(2) *= -1;
  return distances_to(surface, measured);
}

/// Whether the points lie on the surface with x and y turned. Three times as near is more than the brain's symmetry
/// makes.
bool on_it_when_turned(const Distances& as_given, const Distances& turned, double farthest_allowed) {
  constexpr double on = 5.0;  // mm
  return (turned.median < on && 3 * turned.median < as_given.median) ||
         (as_given.farthest > farthest_allowed && turned.farthest <= farthest_allowed);
}

}  // namespace

void check_load(const CraniotomyLoad& load) {
  if (load.positions.rows() == 0 || load.positions.rows() != load.displacement.rows()) {
    throw std::invalid_argument("load: no displacement is measured, or not one at each position");
  }
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    if (!load.positions.row(p).allFinite() || !load.displacement.row(p).allFinite()) {
      throw std::invalid_argument("load: measured point " + std::to_string(p + 1) + " is not finite");
    }
  }
}

void check_near_surface(const Points& measured, const Points& surface, double farthest_allowed,
                        std::span<const Eigen::Index> rows, Eigen::Index all) {
  const PointTree tree(surface);
  const Distances as_given = distances_to(tree, measured);
  constexpr double off = 10.0;  // mm, in the median: points on a cortex lie within a spacing of its nodes
  if (as_given.median <= off && as_given.farthest <= farthest_allowed) {
    return;
  }
  const Distances turned = distances_when_turned(tree, measured);
  if (on_it_when_turned(as_given, turned, farthest_allowed)) {
    throw std::invalid_argument(
        "load: the measured points lie " + with_decimals(as_given.median) +
        " mm off the brain's surface (median; farthest " + with_decimals(as_given.farthest) +
        " mm), and with x and y flipped all lie within " + with_decimals(turned.farthest) +
        " mm of it: RAS was most likely taken for LPS, or LPS for RAS; correct the frame that the load's file names");
  }
  if (as_given.farthest > farthest_allowed) {
    const Eigen::RowVector3d p = measured.row(as_given.farthest_row);
    const Eigen::Index row = all == 0 ? as_given.farthest_row : rows[static_cast<std::size_t>(as_given.farthest_row)];
    throw std::invalid_argument(
        "load: measured point " + std::to_string(row + 1) + " of " + std::to_string(all == 0 ? measured.rows() : all) +
        " at (" + with_decimals(p.x()) + ", " + with_decimals(p.y()) + ", " + with_decimals(p.z()) + ") LPS is " +
        with_decimals(as_given.farthest) + " mm from the nearest surface node, " + with_decimals(farthest_allowed) +
        " mm are allowed; are image and load in the same frame?");
  }
}

void check_frame(const Points& measured, const Points& surface, double farthest_allowed) {
  constexpr double off = 10.0;  // mm
  const PointTree tree(surface);
  const Distances as_given = distances_to(tree, measured), turned = distances_when_turned(tree, measured);
  if (as_given.median > off && 3 * turned.median < as_given.median && turned.farthest <= farthest_allowed) {
    throw std::invalid_argument("load: the measured points lie " + with_decimals(as_given.median) +
                                " mm off the brain's surface (median), and with x and y flipped " +
                                with_decimals(turned.median) +
                                " mm: RAS was most likely taken for LPS, or LPS for RAS; correct the frame that the "
                                "load's file names");
  }
  const double across = (measured.colwise().maxCoeff() - measured.colwise().minCoeff()).maxCoeff();
  constexpr double in_metres = 1.0;
  if (measured.rows() >= 3 && across > 0 && across < in_metres) {
    throw std::invalid_argument("load: all " + std::to_string(measured.rows()) +
                                " measured points lie within a millimetre; positions in mm are expected");
  }
}

double share_not_taken(const Points& measured, const NodeCloud& cloud, const Points& prescribed) {
  const std::vector<std::int32_t> surface = surface_nodes(cloud);
  std::vector<std::int32_t> loaded;
  for (const std::int32_t node : surface) {
    if (!prescribed.row(node).array().isNaN().all()) {
      loaded.push_back(node);
    }
  }
  if (loaded.empty()) {
    return 1;
  }
  const Points places = cloud.positions(surface, Eigen::all), taken = cloud.positions(loaded, Eigen::all);
  const PointTree all(places), of_taken(taken);
  double lost = 0;
  for (Eigen::Index p = 0; p < measured.rows(); ++p) {
    const Eigen::RowVector3d place = measured.row(p);
    const auto [nearest, squared] = all.nearest(place.data());
    const double spacing = cloud.spacing[static_cast<std::size_t>(surface[nearest])];
    lost += std::sqrt(of_taken.nearest(place.data()).second) > std::sqrt(squared) + 2 * spacing ? 1 : 0;
  }
  return lost / static_cast<double>(measured.rows());
}

void check_taken(const Points& measured, const NodeCloud& cloud, const Points& prescribed) {
  if (const double share = share_not_taken(measured, cloud, prescribed); share > 0.5) {
    throw std::invalid_argument("load: " + with_decimals(100 * share) + " % of the " + std::to_string(measured.rows()) +
                                " measured points lie over no node that is loaded: they do not lie about one opening, "
                                "as on both sides of the brain or all around it; give those of one opening");
  }
}

void check_no_places(const CraniotomyLoad& load) {
  constexpr double short_way = 15, alike = 0.25;  // mm, of the places
  const double places = load.positions.rowwise().norm().maxCoeff();
  const double apart = (load.displacement - load.positions).rowwise().norm().maxCoeff();
  if (apart < alike * places && load.displacement.rowwise().norm().minCoeff() > short_way) {
    throw std::invalid_argument("load: its displacements are nearly its places, " + with_decimals(apart) +
                                " mm apart at most: are they where the points went? Give by how much each moved");
  }
}

void check_moved(const Points& displacement, const Points& surface) {
  const double across = (surface.colwise().maxCoeff() - surface.colwise().minCoeff()).maxCoeff();
  Eigen::Index farthest = 0;
  const double moved = displacement.rowwise().norm().maxCoeff(&farthest);
  if (!(moved <= 0.5 * across)) {
    throw std::invalid_argument("load: measured point " + std::to_string(farthest + 1) + " of " +
                                std::to_string(displacement.rows()) + " moves by " + with_decimals(moved) +
                                " mm, more than half of the body (" + with_decimals(across) +
                                " mm across); displacements in mm are expected");
  }
}

}  // namespace brainshift::solve
