// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/extremes/brain.hpp"

#include "discretise/discretise.hpp"
#include "segmentation/files/surface_file.hpp"
#include "tests/unit/solve/all_free.hpp"

namespace brainshift::extremes {

solve::Model brain_model(std::size_t nodes, double sink) {
  discretise::DiscretiseOptions options;
  options.nodes = nodes;
  const discretise::Discretisation parts =
      discretise::discretise(read_surface(BRAINSHIFT_REFERENCES "/brain_surface.vtp"), nullptr, options);
  solve::Model model;
  model.cloud = parts.cloud;
  model.conditions = test::all_free(model.cloud);
  model.cells = parts.cells;
  model.materials[1] = {3000, 0.49, 1000};
  const auto& x = model.cloud.positions;
  const double bottom = x.col(2).minCoeff(), top = x.col(2).maxCoeff();
  for (Eigen::Index a = 0; a < x.rows(); ++a) {
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] == 0) {
      continue;
    }
    const double share = (x(a, 2) - bottom) / (top - bottom);
    if (share < 0.2) {
      model.conditions.displacement.row(a).setZero();
    } else if (share > 0.9) {
      model.conditions.displacement.row(a) << 0, 0, -sink;
    }
  }
  return model;
}

double largest_difference(const Points& u, const Points& wanted) {
  return u.rows() == wanted.rows() ? (u - wanted).rowwise().norm().maxCoeff() : std::nan("");
}

}  // namespace brainshift::extremes
