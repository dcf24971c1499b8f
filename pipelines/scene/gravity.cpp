// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/gravity.hpp"

#include <stdexcept>

#include "solve/boundary/fluid_force.hpp"

namespace brainshift::pipelines {

namespace {

constexpr double standard_gravity = 9.80665;  // m/s²

double level(const Gravity& gravity, const Points& nodes) {
  if (gravity.fluid_level) {
    return *gravity.fluid_level;
  }
  if (gravity.fluid_point) {
    return gravity.fluid_point->dot(gravity.direction.normalized());
  }
  return solve::drained_level(gravity.direction, *gravity.drained / 100, nodes);
}

}  // namespace

solve::DrainedFluid drained_fluid(const Gravity& gravity, const Points& nodes) {
  const Eigen::Vector3d& of_image = gravity.image_direction.value_or(gravity.direction);
  return {.gravity = standard_gravity * gravity.direction.normalized(),
          .gravity_of_image = standard_gravity * of_image.normalized(),
          .level = level(gravity, nodes),
          .density = gravity.fluid_density};
}

void check_gravity(const Gravity& gravity) {
  if (gravity.direction.isZero() || (gravity.image_direction && gravity.image_direction->isZero())) {
    throw std::invalid_argument(
        "a direction of <gravity> is 0,0,0; say which way things fall: 0,0,-1 when the patient sits, 0,1,0 on the "
        "back");
  }
  const int levels = (gravity.fluid_level ? 1 : 0) + (gravity.drained ? 1 : 0) + (gravity.fluid_point ? 1 : 0);
  if (levels != 1) {
    throw std::invalid_argument("<gravity> says " + std::to_string(levels) +
                                " levels of the fluid; give exactly one of fluid_level, drained, fluid_point");
  }
}

}  // namespace brainshift::pipelines
