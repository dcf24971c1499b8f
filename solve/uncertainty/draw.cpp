// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/uncertainty/draw.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "discretise/cloud/random.hpp"

namespace brainshift::solve {

namespace {

/// Standard normal, by Box and Muller: the library's distributions are not the same everywhere.
double normal(discretise::Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
  return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

Material drawn_material(Material material, const UncertaintyOptions& options, discretise::Random& random) {
  const double factor = std::exp(options.stiffness * normal(random)), place = random.uniform();
  material = stiffened(std::move(material), factor);
  const double own = material.poisson_ratio;
  constexpr double least = -0.99;
  const double low = std::max(own - options.poisson, least), high = std::min(own + options.poisson, most_poisson);
  if (low < high) {
    material.poisson_ratio = low + place * (high - low);
  }
  return material;
}

Eigen::Matrix3d tilt(const Eigen::Vector3d& direction, double degrees, discretise::Random& random) {
  const Eigen::Vector3d first = direction.unitOrthogonal();
  const Eigen::Vector3d second = direction.normalized().cross(first);
  const double one = normal(random), two = normal(random);
  const Eigen::Vector3d turn = degrees * std::numbers::pi / 180 * (one * first + two * second);
  return turn.norm() > 0 ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()
                         : Eigen::Matrix3d::Identity();
}

DrainedFluid drawn_fluid(DrainedFluid fluid, const Eigen::Vector3d& middle, const UncertaintyOptions& options,
                         discretise::Random& random) {
  const Eigen::Matrix3d turn = tilt(fluid.gravity, options.gravity_angle, random);
  const double depth = fluid.level - middle.dot(fluid.gravity.normalized());
  fluid.gravity = turn * fluid.gravity;
  fluid.gravity_of_image = turn * fluid.gravity_of_image;
  fluid.level = middle.dot(fluid.gravity.normalized()) + depth + options.fluid_level * normal(random);
  return fluid;
}

}  // namespace

Constants drawn_constants(const Model& model, const UncertaintyOptions& options, int sample) {
  constexpr std::uint64_t most_samples = 1 << 20;
  discretise::Random random(static_cast<std::uint64_t>(options.seed) * most_samples +
                            static_cast<std::uint64_t>(sample));
  Constants constants{.materials = {}, .gravity = model.gravity, .fluid = model.fluid};
  for (const auto& [label, material] : model.materials) {
    constants.materials[label] = drawn_material(material, options, random);
  }
  if (!model.gravity.isZero()) {
    constants.gravity = tilt(model.gravity, options.gravity_angle, random) * model.gravity;
  }
  if (model.fluid) {
    const Eigen::Vector3d middle = model.cloud.positions.colwise().mean();
    constants.fluid = drawn_fluid(*model.fluid, middle, options, random);
  }
  return constants;
}

bool varies(const Model& model, const UncertaintyOptions& options) {
  return options.stiffness > 0 || options.poisson > 0 ||
         (options.gravity_angle > 0 && (model.fluid || !model.gravity.isZero())) ||
         (options.fluid_level > 0 && model.fluid);
}

}  // namespace brainshift::solve
