// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/check_uncertainty.hpp"

#include <stdexcept>

#include "solve/load/craniotomy_load.hpp"
#include "solve/uncertainty/draw.hpp"
#include "solve/uncertainty/sample.hpp"

namespace brainshift::pipelines {
namespace {

bool has_noise(const Load& load) {
  return load.noise || (load.craniotomy && solve::read_craniotomy_csv(*load.craniotomy).sigma.rows() > 0);
}

}  // namespace

void check_uncertainty(const Scene& scene) {
  solve::Model model;
  model.gravity = scene.loading.gravity;
  if (scene.gravity) {
    model.fluid.emplace();
  }
  model.cuts.resize(scene.cuts ? 1 : 0);
  if (scene.septa || scene.septum) {
    model.septum.emplace();
  }
  model.resection = scene.resection;
  solve::check_sampled(model, scene.solve);
  if (!solve::varies(model, *scene.uncertainty) && !(scene.load && has_noise(*scene.load))) {
    throw std::invalid_argument(
        "nothing of the scene is uncertain: the load has no noise and all constants are known; give <load> a noise, or "
        "one of stiffness, poisson, gravity_angle and fluid_level more than 0, or leave <uncertainty> out");
  }
}

}  // namespace brainshift::pipelines
