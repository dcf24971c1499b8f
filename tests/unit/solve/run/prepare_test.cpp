// SPDX-License-Identifier: GPL-3.0-or-later
//
// A part that a model does not have holds no memory: it is absent from what is prepared, or empty.

#include "solve/run/prepare.hpp"

#include <gtest/gtest.h>

#include "solve/run/completed.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/cut_bodies.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::prepare_test {

Prepared prepared(const Model& model, const SolveOptions& options = {}) {
  SolveMeasures measures;
  return prepare(model, completed(options, model), {}, measures, {});
}

/// A strip with a path from its edge to its middle that is there at the time, or with none.
Model strip_cut_at(std::optional<double> time) {
  Model model = test::strip(1.1);
  if (time) {
    model.cuts = {test::cut_path({{-1, 10}, {15, 10}}, {*time, *time})};
  }
  return model;
}

TEST(Prepare, HasNoContactWithoutASkull) {
  Model model = uniaxial(1.02, 5);
  EXPECT_FALSE(prepared(model).body.contact);
  model.skull = test::box(Eigen::Vector3d::Constant(-5), Eigen::Vector3d::Constant(model_side + 5));
  EXPECT_TRUE(prepared(model).body.contact);
}

TEST(Prepare, HasForcesOnlyWhereSomethingPushes) {
  Model model = uniaxial(1.02, 5);
  EXPECT_TRUE(prepared(model).body.external.empty());
  Model heavy = model;
  heavy.gravity = {0, 0, -9.81};
  EXPECT_EQ(prepared(heavy).body.external.full().size(), 4 * model.cloud.size());
  Model filled = model;
  filled.body_force = [](const Eigen::Vector3d&, std::int32_t) { return Eigen::Vector3d(0, 0, 1e-6); };
  EXPECT_EQ(prepared(filled).body.external.full().size(), 4 * model.cloud.size());
  model.conditions.force = Points::Constant(model.cloud.positions.rows(), 3, 1e-6);
  EXPECT_EQ(prepared(model).body.external.full().size(), 4 * model.cloud.size());
}

TEST(Prepare, HasPressureModesOnlyWherePointsShareAPressure) {
  const Model model = uniaxial(1.02, 5);
  SolveOptions options;
  EXPECT_FALSE(prepared(model, options).body.points.mode.empty());
  options.volumetric = Volumetric::pointwise;
  EXPECT_TRUE(prepared(model, options).body.points.mode.empty());
  EXPECT_TRUE(prepared(test::strip(1.1, Plane::stress)).body.points.mode.empty());
}

TEST(Prepare, HasMassesOnlyInTimeAndAMemoryOfStressOnlyWhereItRelaxes) {
  Model model = stretched(1.02, 0.1, 0.1);
  EXPECT_TRUE(prepared(model).body.mass.empty());
  EXPECT_EQ(prepared(model, in_time()).body.mass.size(), model.cloud.size());
  EXPECT_TRUE(prepared(model, in_time()).body.prony.empty());
  model.materials[1].prony = {{0.4, 0.5}};
  EXPECT_TRUE(prepared(model).body.prony.empty()) << "at rest";
  EXPECT_EQ(prepared(model, in_time()).body.prony.size(), 1u);
}

TEST(Prepare, HoldsNoNodeWhereNothingIsPrescribed) {
  Model model = box_model(test::box_cells(4, model_side), 5);
  model.gravity = {0, 0, -9.81};
  EssentialConditions none = prepared(model, in_time()).body.essential;
  none.factorise(std::vector<double>(model.cloud.size(), 1.0));
  NodalVectors parameters(4 * model.cloud.size(), 0.5);
  none.apply(1, parameters);
  EXPECT_EQ(parameters, NodalVectors(4 * model.cloud.size(), 0.5));
  EXPECT_TRUE(none.reactions(1, model.cloud.size()).isZero(0));
}

TEST(Prepare, KeepsACutOnlyWhereThereIsOneAndItsPartsOnlyWhereItGoesOn) {
  const Prepared whole = prepared(strip_cut_at({}));
  EXPECT_FALSE(whole.cut || whole.parts);
  EXPECT_TRUE(whole.body.cut.empty());
  const Prepared open = prepared(strip_cut_at(0));
  EXPECT_TRUE(open.cut);
  EXPECT_FALSE(open.parts);
  EXPECT_FALSE(open.body.cut.empty());
  const Prepared to_be_cut = prepared(strip_cut_at(0.5));
  EXPECT_TRUE(to_be_cut.cut && to_be_cut.parts);
  EXPECT_TRUE(to_be_cut.body.cut.empty()) << "at the start nothing is cut";
}

TEST(Prepare, HasContactOfFacesOnlyWhereItIsAskedFor) {
  Model model = strip_cut_at(0);
  EXPECT_FALSE(prepared(model).body.face_contact);
  model.face_contact = true;
  EXPECT_TRUE(prepared(model).body.face_contact);
}

}  // namespace brainshift::solve::prepare_test
