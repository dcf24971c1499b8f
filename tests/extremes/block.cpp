// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/extremes/block.hpp"

#include <cmath>

#include "solve/shape/node_supports.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/material_cases.hpp"

namespace brainshift::extremes {

solve::Model Block::model(NodeCloud cloud, BackgroundCells cells) const {
  solve::Model model;
  model.cloud = std::move(cloud);
  model.conditions = test::all_free(model.cloud);
  model.cells = std::move(cells);
  model.materials[1] = material;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    for (int axis = 0; axis < 3; ++axis) {
      if (model.cloud.positions(a, axis) == 0) {
        model.conditions.displacement(a, axis) = 0;
      }
    }
    if (model.cloud.positions(a, 2) == size[2]) {
      model.conditions.displacement(a, 2) = (stretch - 1) * size[2];
    }
  }
  return model;
}

/// F with the sides stretched until they carry no stress, by bisection.
Eigen::Matrix3d Block::exact() const {
  double low = 0.1, high = 10;
  Eigen::Matrix3d gradient;
  for (int i = 0; i < 100; ++i) {
    const double side = std::sqrt(low * high);
    gradient = Eigen::Vector3d(side, side, stretch).asDiagonal();
    (solve::stress(solve::elastic_law(material), gradient)(0, 0) < 0 ? low : high) = side;
  }
  return gradient;
}

double Block::energy() const {
  constexpr double milli_joule = 1e-6;  // Pa mm³
  return milli_joule * solve::energy(solve::elastic_law(material), exact()) * size.prod();
}

std::vector<Measured> Block::errors(const solve::SolveResult& result, double most_displacement,
                                    double most_force) const {
  const Eigen::Matrix3d gradient = exact();
  const Points& x = result.solution.positions;
  const Points wanted = x * (gradient - Eigen::Matrix3d::Identity());
  const double imposed = std::abs(stretch - 1) * size[2];
  const double off = x.rows() > 0 ? (result.solution.displacement - wanted).rowwise().norm().maxCoeff() : std::nan("");
  constexpr double per_square_millimetre = 1e-6;  // Pa to N/mm²
  const double force =
      per_square_millimetre * size[0] * size[1] * solve::stress(solve::elastic_law(material), gradient)(2, 2);
  double pulled = 0;
  for (Eigen::Index a = 0; a < x.rows(); ++a) {
    pulled += x(a, 2) == size[2] ? result.solution.reaction_force(a, 2) : 0;
  }
  return {{"displacement off by", 100 * off / imposed, most_displacement, "% of the imposed"},
          {"force by", 100 * std::abs(pulled / force - 1), most_force, "%"}};
}

}  // namespace brainshift::extremes
