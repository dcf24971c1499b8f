// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/opening.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace brainshift::pipelines {

namespace {

using Eigen::Vector3d;

// Where the segment from `inside` to `outside` crosses the brain's surface.
Vector3d surface_between(const Egg& brain, Vector3d inside, Vector3d outside) {
  for (int halving = 0; halving < 60; ++halving) {
    const Vector3d middle = 0.5 * (inside + outside);
    (brain.level(middle) < 1 ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

Vector3d outward_normal(const Egg& brain, const Vector3d& point) {
  const double step = 1e-4 * brain.half_length;
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d offset = step * Vector3d::Unit(axis);
    gradient[axis] = brain.level(point + offset) - brain.level(point - offset);
  }
  return gradient.normalized();
}

}  // namespace

Opening make_opening(const Head& head) {
  const Vector3d direction = (head.tumour.centre - head.brain.centre).normalized();
  const Vector3d far = head.brain.centre + 2 * head.brain.half_length * direction;
  const Vector3d centre = surface_between(head.brain, head.brain.centre, far);
  return {.centre = centre,
          .normal = outward_normal(head.brain, centre),
          .radius = 26 * head.scale,
          .depth = 8 * head.scale};
}

solve::CraniotomyLoad measured_load(const Head& head, const Opening& opening) {
  constexpr int count = 90;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const Vector3d across = opening.normal.unitOrthogonal();
  const Vector3d along = opening.normal.cross(across);
  solve::CraniotomyLoad load{.positions = Points(count, 3), .displacement = Points(count, 3)};
  for (int i = 0; i < count; ++i) {
    const double relative = std::sqrt((i + 0.5) / count);
    const double angle = i * golden_angle;
    const Vector3d in_plane =
        opening.centre + relative * opening.radius * (std::cos(angle) * across + std::sin(angle) * along);
    const Vector3d reach = opening.radius * opening.normal;
    const double sink = opening.depth * (1 + std::cos(0.8 * std::numbers::pi * relative)) / 2;
    load.positions.row(i) = surface_between(head.brain, in_plane - reach, in_plane + reach).transpose();
    load.displacement.row(i) = -sink * opening.normal.transpose();
  }
  return load;
}

}  // namespace brainshift::pipelines
