// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/inner_rows.hpp"

#include <cmath>
#include <map>

namespace brainshift::solve {

namespace {

/// The centre and twelve places on a sphere of radius 1, evenly.
Points places_of_ball() {
  const double golden = (1 + std::sqrt(5.0)) / 2, scale = 1 / std::sqrt(1 + golden * golden);
  Points places = Points::Zero(13, 3);
  Eigen::Index row = 1;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      for (int axis = 0; axis < 3; ++axis) {
        places(row, axis) = scale * a;
        places(row, (axis + 1) % 3) = scale * b;
        ++row;
      }
    }
  }
  return places;
}

}  // namespace

ShapeRows inner_rows(const ShapeFunctions& shape, const Points& points) {
  const Points ball = seen_radius * places_of_ball();
  Points places(points.rows() * ball.rows(), 3);
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    places.middleRows(p * ball.rows(), ball.rows()) = ball.rowwise() + points.row(p);
  }
  const ShapeRows all = shape.evaluate(places, false);
  ShapeRows means;
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    std::map<std::int32_t, double> mean;
    for (Eigen::Index i = 0; i < ball.rows(); ++i) {
      const ShapeRow row = all[static_cast<std::size_t>(p * ball.rows() + i)];
      for (std::size_t k = 0; k < row.size(); ++k) {
        mean[row.node[k]] += row.value[k] / static_cast<double>(ball.rows());
      }
    }
    std::vector<std::int32_t> nodes;
    std::vector<double> values;
    for (const auto& [node, value] : mean) {
      nodes.push_back(node);
      values.push_back(value);
    }
    means.append({nodes, values, {}});
  }
  return means;
}

}  // namespace brainshift::solve
