// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/field_difference.hpp"

#include <stdexcept>
#include <vector>

#include "segmentation/geometry/quantile.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::solve {

Points displacement_at(const Solution& solution, const Points& points) {
  const ShapeFunctions shape = shape_functions(solution);
  return shape.interpolate(points, parameters_from_displacement(shape, solution.positions, solution.displacement));
}

FieldDifference field_difference(const Points& u, const Points& v) {
  if (u.rows() == 0 || u.rows() != v.rows()) {
    throw std::invalid_argument("two fields can be compared at the same points only, at least one");
  }
  const Eigen::VectorXd distance = (u - v).rowwise().norm();
  return {distance.maxCoeff(), quantile(std::vector<double>(distance.begin(), distance.end()), 0.95), distance.mean()};
}

FieldDifference field_difference(const Solution& reference, const Solution& other) {
  return field_difference(reference.displacement, displacement_at(other, reference.positions));
}

}  // namespace brainshift::solve
