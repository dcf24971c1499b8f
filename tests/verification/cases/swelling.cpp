// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bar of two bonded layers of which the lower one swells: it bends. Against finite elements that are heated.
#include <cmath>

#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/cases/relative_figures.hpp"

namespace brainshift::verification::swelling_cases {

Outcome bilayer(bool small) {
  const Eigen::Vector3d size(40, 10, 20);  // a quarter, mirrored at x = 0 and y = 0; the layers meet at z = 10
  const double least_distance = small ? 2.2 : 1.5;
  solve::Model model;
  model.cloud = box_cloud(size, least_distance, 4);
  model.conditions = test::all_free(model.cloud);
  const int layer = static_cast<int>(std::round(size.y() / (1.2 * least_distance)));
  const Eigen::Vector3i cells(4 * layer, layer, 2 * layer);
  model.cells = test::box_cells(cells, size);
  for (std::size_t i = 0; i < model.cells.size(); ++i) {
    const auto level = static_cast<int>(i) / (cells.x() * cells.y());  // x runs fastest
    model.cells.label[i] = level < layer ? 1 : 2;
  }
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    for (const int axis : {0, 1}) {
      if (x[axis] == 0) {
        model.conditions.displacement(a, axis) = 0;
      }
    }
    if (x.isZero()) {
      model.conditions.displacement(a, 2) = 0;
    }
  }
  model.materials[1] = {.youngs_modulus = 3000, .poisson_ratio = 0.49, .swelling = 0.01};
  model.materials[2] = {.youngs_modulus = 3000, .poisson_ratio = 0.49};
  solve::SolveOptions options = steady_options();
  options.tolerance = 1e-4;  // of a quarter of a millimetre
  return {relative_figures(solved(model, options), read_reference("bilayer", ""), 1), {}};
}

}  // namespace brainshift::verification::swelling_cases
