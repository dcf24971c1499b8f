// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>

#include "solve/interface/model.hpp"

namespace brainshift::solve {

/// The constants of a model that may be other than they say.
struct Constants {
  std::map<std::int32_t, Material> materials;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< m/s²
  std::optional<DrainedFluid> fluid = {};
};

/// The model with these constants. Which tissue sees whose nodes stays as with its own: samples differ by what they
/// sample alone.
inline Model with_constants(Model model, const Constants& constants) {
  if (model.contrast.empty()) {
    model.contrast = model.materials;
  }
  model.materials = constants.materials;
  model.gravity = constants.gravity;
  model.fluid = constants.fluid;
  return model;
}

}  // namespace brainshift::solve
