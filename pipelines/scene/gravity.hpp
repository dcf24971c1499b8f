// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "segmentation/geometry/points.hpp"
#include "solve/interface/model.hpp"

namespace brainshift::pipelines {

/// The part <gravity>: the brain floats in the image, and the fluid drains to a level.
struct Gravity {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< LPS, any length
  std::optional<Eigen::Vector3d> image_direction = {};  ///< absent: the same
  std::optional<double> fluid_level = {};               ///< mm along the direction
  std::optional<double> drained = {};                   ///< % of the brain's height
  std::optional<Eigen::Vector3d> fluid_point = {};      ///< on the fluid's surface, mm, LPS
  double fluid_density = 1007;                          ///< kg/m³
};

/// What the solver is told. nodes (n × 3) of the body, mm: `drained` counts from its top.
solve::DrainedFluid drained_fluid(const Gravity& gravity, const Points& nodes);

/// Throws std::invalid_argument unless there is a direction and exactly one level.
void check_gravity(const Gravity& gravity);

}  // namespace brainshift::pipelines
