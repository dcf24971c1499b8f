// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bodies whose fluid has drained to half their height, against finite elements that carry the weight on all of the
// tissue and the fluid's pressure on the wet faces: the solver has the lost buoyancy above the level alone.
#include <cmath>

#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/hold_bottom.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/cases/relative_figures.hpp"

namespace brainshift::verification::fluid_cases {

namespace {

constexpr double gravity = 9.80665;  // m/s²

/// Nearly incompressible: the fluid's pressure inside the finite elements squeezes them by pressure over bulk modulus,
/// which is no part of the solver's load.
const solve::Material tissue = {.youngs_modulus = 3000, .poisson_ratio = 0.499};

solve::DrainedFluid drained_to(double z) {
  const Eigen::Vector3d down(0, 0, -gravity);
  return {.gravity = down, .gravity_of_image = down, .level = -z, .density = 1007};
}

}  // namespace

Outcome wet_block(bool small) {
  const Eigen::Vector3d size(20, 20, 40);  // a quarter, mirrored at x = 0 and y = 0
  const double least_distance = small ? 3 : 2;
  solve::Model model;
  model.cloud = box_cloud(size, least_distance, 4);
  model.conditions = test::all_free(model.cloud);
  const int cells = static_cast<int>(std::round(size.x() / (1.2 * least_distance)));
  model.cells = test::box_cells(Eigen::Vector3i(cells, cells, 2 * cells), size);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    auto prescribed = model.conditions.displacement.row(a);
    for (int axis = 0; axis < 3; ++axis) {
      if (x[axis] == 0 || x.z() == 0) {
        prescribed[axis] = 0;
      }
    }
  }
  model.materials[1] = tissue;
  model.fluid = drained_to(20);
  return {relative_figures(solved(model, steady_options()), read_reference("wet_block", ""), 1.5), {}};
}

Outcome wet_ball(bool small) {
  constexpr double radius = 30;
  solve::Model model;
  model.cloud = half_ball_cloud(radius, small ? 4 : 2.7, 4);
  model.conditions = test::all_free(model.cloud);
  model.boundary = half_ball_surface(radius);
  model.cells = cells_over(*model.boundary, model.cloud.size(), 1.5);
  solve::hold_bottom(model);
  model.materials[1] = tissue;
  model.fluid = drained_to(15);
  return {relative_figures(solved(model, steady_options()), read_reference("wet_ball", ""), 1), {}};
}

}  // namespace brainshift::verification::fluid_cases
