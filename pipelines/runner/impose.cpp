// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/impose.hpp"

#include "solve/load/near_surface.hpp"
#include "solve/load/noisy_load.hpp"

namespace brainshift::pipelines {

void add_noise(const Load& how, solve::CraniotomyLoad& load) {
  if (load.sigma.rows() == 0 && how.noise) {
    load.sigma = Points::Constant(load.positions.rows(), 3, *how.noise);
  }
}

solve::Conditions imposed(const solve::CraniotomyLoad& load, const Load& how, const NodeCloud& cloud) {
  if (load.sigma.rows() == 0) {
    solve::Conditions exact{.displacement = solve::prescribed_on_surface_nodes(cloud, load, how.opening)};
    solve::check_taken(load.positions, cloud, exact.displacement);
    return exact;
  }
  solve::Conditions conditions = solve::noisy_conditions(cloud, load, how.opening);
  conditions.measured->weight = how.weight;
  return conditions;
}

}  // namespace brainshift::pipelines
