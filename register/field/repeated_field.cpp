// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/repeated_field.hpp"

#include <cmath>

#include "register/field/forward_field.hpp"
#include "register/field/outside.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/shape/nodal_displacement.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::registration {

RepeatedField::RepeatedField(const Solution& solution, const Surface& brain, const ImageGeometry& grid, double fade)
    : grid_(grid), fade_(fade), spacing_(least_spacing(solution.spacing)), zones_(brain_zones(brain, grid, fade)) {
  const solve::ShapeFunctions shape = shape_functions(solution);
  const auto keep_rows = [&](const Points& places) -> Points {
    rows_.push_back(shape.evaluate(places, false));
    return Points::Zero(places.rows(), 3);
  };
  forward_field(keep_rows, spacing_, zones_, grid_, fade_, {}, &plan_);
}

VectorImage RepeatedField::forward(const Points& parameters) {
  std::size_t part = 0;
  return forward_field([&](const Points&) { return solve::values_of(rows_[part++], parameters); }, spacing_, zones_,
                       grid_, fade_, {}, &plan_);
}

ImageGeometry covering_grid(const ImageGeometry& image, double spacing) {
  const Eigen::Array3d extent = image.spacing.array() * image.size.cast<double>();
  ImageGeometry grid = image;
  grid.spacing.setConstant(spacing);
  grid.size = (extent / spacing).ceil().cast<int>().max(1);
  grid.origin += image.direction * (grid.spacing - image.spacing) / 2;  // the same outermost corner
  return grid;
}

}  // namespace brainshift::registration
