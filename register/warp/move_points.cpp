// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/point_mover.hpp"
#include "register/warp/warp.hpp"

namespace brainshift::registration {

Points move_points(PointMover& mover, const Points& points) {
  Points moved = points;
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    moved.row(p) += mover.displacement(points.row(p)).transpose();
  }
  return moved;
}

Points move_points(const VectorImage& forward, const Points& points) {
  PointMover mover(forward);
  return move_points(mover, points);
}

}  // namespace brainshift::registration
