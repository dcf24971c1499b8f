// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve {
namespace {

using test::box_cells;

/// A closed box, outward, as a skull.
Surface box_skull(double low, double high) {
  Surface box;
  box.vertices.resize(8, 3);
  for (int i = 0; i < 8; ++i) {
    box.vertices.row(i) << (i & 1 ? high : low), (i & 2 ? high : low), (i & 4 ? high : low);
  }
  box.triangles.resize(12, 3);
  box.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3,
      7, 5;
  return box;
}

HeldBytes held(const Model& model, SolveOptions options) {
  options.max_steps = 40;
  return solve(model, options).measures.bytes;
}

TEST(HeldBytes, PartsThatTheModelDoesNotHaveAreZero) {
  const Model model = uniaxial(1.02, 5);
  SolveOptions options;
  options.volumetric = Volumetric::pointwise;
  const HeldBytes bytes = held(model, options);
  EXPECT_EQ(bytes.contact, 0u);
  EXPECT_EQ(bytes.viscosity, 0u);
  EXPECT_EQ(bytes.external_forces, 0u);
  EXPECT_EQ(bytes.pressure_patches, 0u);
  EXPECT_GT(bytes.essential_conditions, 0u);
  EXPECT_GT(bytes.nodal_vectors, 0u);
  EXPECT_GT(bytes.shape_functions, 0u);
}

TEST(HeldBytes, PartsThatItHasAreNot) {
  Model model = uniaxial(1.02, 5);
  model.skull = box_skull(-5, model_side + 5);
  model.gravity = {0, 0, -9.81};
  const HeldBytes bytes = held(model, {});
  EXPECT_GT(bytes.contact, 0u);
  EXPECT_GT(bytes.external_forces, 0u);
  EXPECT_GT(bytes.pressure_patches, 0u);
}

TEST(HeldBytes, OnlyATransientRunRemembersTheStress) {
  Model model = stretched(1.02, 0.1, 0.1);
  model.materials[1].prony = {{0.4, 0.5}};
  EXPECT_EQ(held(model, {}).viscosity, 0u);
  EXPECT_GT(held(model, in_time()).viscosity, 0u);
  const std::size_t with = held(model, in_time()).nodal_vectors;
  model.materials[1].prony.clear();
  EXPECT_EQ(held(model, in_time()).viscosity, 0u);
  EXPECT_EQ(held(model, in_time()).nodal_vectors, with);
}

TEST(HeldBytes, NothingPrescribedHoldsNothing) {
  Model model = box_model(box_cells(4, model_side), 5);
  model.gravity = {0, 0, -9.81};
  EXPECT_EQ(held(model, in_time()).essential_conditions, 0u);
}

}  // namespace
}  // namespace brainshift::solve
