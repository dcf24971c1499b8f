// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/repeated_field.hpp"

#include <gtest/gtest.h>

#include "register/field/forward_field.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::repeated_field_test {

using namespace builders;

TEST(RepeatedField, IsTheForwardFieldOfEachDisplacement) {
  RegisterInput input = head(sinking);
  const double fade = 20;
  RepeatedField field(input.solution, input.brain, input.t1.geometry, fade);
  const BrainZones zones = brain_zones(input.brain, input.t1.geometry, fade);
  const solve::ShapeFunctions shape = shape_functions(input.solution);
  for (const double factor : {1.0, -0.5}) {
    input.solution.displacement *= factor;
    const VectorImage expected = forward_field(input.solution, zones, input.t1.geometry, fade, {});
    const VectorImage made = field.forward(
        solve::parameters_from_displacement(shape, input.solution.positions, input.solution.displacement));
    float largest = 0;
    for (std::size_t v = 0; v < made.voxels.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        largest = std::max(largest, std::abs(made.voxels[v][axis] - expected.voxels[v][axis]));
      }
    }
    EXPECT_LE(largest, 1.0F / 4096);  // as it is rounded
  }
}

TEST(CoveringGrid, BeginsAtTheImagesCornerAndReachesPastItsEnd) {
  ImageGeometry image;
  image.size = {10, 11, 1};
  image.spacing = {1, 1, 3};
  image.origin = {5, 6, 7};
  image.direction << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const ImageGeometry grid = covering_grid(image, 2.5);
  EXPECT_TRUE((grid.size == Eigen::Array3i(4, 5, 2)).all());
  EXPECT_LT((grid.to_world({-0.5, -0.5, -0.5}) - image.to_world({-0.5, -0.5, -0.5})).norm(), 1e-12);
  EXPECT_TRUE((grid.spacing.array() == 2.5).all());
}

}  // namespace brainshift::registration::repeated_field_test
