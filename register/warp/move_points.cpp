// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/field_sampler.hpp"
#include "register/warp/warp.hpp"

namespace brainshift::registration {

Points move_points(const VectorImage& forward, const Points& points) {
  const FieldSampler sampler(forward);
  Points moved = points;
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    const Eigen::Vector3d index = sampler.to_index(points.row(p));
    if (sampler.inside(index)) {
      moved.row(p) += sampler.value(index).transpose();
    }
  }
  return moved;
}

}  // namespace brainshift::registration
