// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/after/cheaper_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace brainshift::pipelines::cheaper_models_test {

using solve::Law;
using solve::Model;
using solve::SolveOptions;

/// One linear tissue, and options of which nothing is cheaper.
Model plain_model() {
  Model model;
  model.materials[1].law = Law::linear_elastic;
  model.cells.label = {1, 1, 2, 2, 2, 9, 9, 9, 9};
  return model;
}

SolveOptions cheapest() {
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.imposition = solve::Imposition::simplified;
  options.precision = solve::Precision::single_precision;
  return options;
}

/// The only cheaper model there is; makes it.
CheaperModel only(Model& model, SolveOptions& options, double largest_stretch = 1) {
  const std::vector<CheaperModel> found = cheaper_models(model, options, largest_stretch);
  EXPECT_EQ(found.size(), 1U);
  found.front().make(model, options);
  EXPECT_TRUE(cheaper_models(model, options, largest_stretch).empty()) << "then it is gone";
  return found.front();
}

TEST(CheaperModels, OfAModelWithoutPartsAreNone) {
  EXPECT_TRUE(cheaper_models(plain_model(), cheapest(), 1.5).empty());
}

TEST(CheaperModels, LeaveOutThePartsOfTheModelOneAtATime) {
  SolveOptions options = cheapest();
  Model model = plain_model();
  model.skull.emplace();
  EXPECT_EQ(only(model, options).part, "contact");
  model.gravity = {0, 0, -9.81};
  EXPECT_EQ(only(model, options).change, "left out");
  EXPECT_TRUE(model.gravity.isZero());
  model.materials[1].prony = {{0.5, 1}};
  EXPECT_TRUE(cheaper_models(model, options, 1).empty()) << "at rest all has relaxed";
  options.dynamics = solve::Dynamics::transient;
  EXPECT_EQ(only(model, options).part, "relaxation of the materials");
  EXPECT_TRUE(model.materials[1].prony.empty());
}

TEST(CheaperModels, LeaveOutAResectionOrItsWall) {
  SolveOptions options = cheapest();
  Model model = plain_model();
  model.resection = solve::Resection{.labels = {2}, .fluid_level = 3, .wall = Surface()};
  const std::vector<CheaperModel> found = cheaper_models(model, options, 1);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].part, "wall of the resection");
  found[1].make(model, options);
  EXPECT_FALSE(model.resection->wall || model.resection->fluid_level);
  EXPECT_EQ(only(model, options).part, "resection");
  EXPECT_FALSE(model.resection);
}

TEST(CheaperModels, TakeTheTissueOfMostCellsThatHasAMaterialForAll) {
  Model model = plain_model();
  model.materials[2] = model.materials[1];
  model.materials[2].youngs_modulus = 50;
  const std::vector<CheaperModel> found = cheaper_models(model, cheapest(), 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].change, "all tissues as tissue 2");
  SolveOptions options;
  found[0].make(model, options);
  EXPECT_EQ(model.materials[1].youngs_modulus, 50);
}

TEST(CheaperModels, TryTheCheaperOfEachOption) {
  Model model = plain_model();
  SolveOptions options = cheapest();
  options.imposition = solve::Imposition::exact;
  EXPECT_EQ(only(model, options).change, "simplified");
  options.shape.basis = Basis::modified_quadratic;
  EXPECT_EQ(only(model, options).change, "linear");
  options.precision = solve::Precision::double_precision;
  EXPECT_EQ(only(model, options).change, "single");
  EXPECT_EQ(options.imposition, solve::Imposition::simplified);
  EXPECT_EQ(options.shape.basis, Basis::linear);
  EXPECT_EQ(options.precision, solve::Precision::single_precision);
}

TEST(CheaperModels, SmallStrainsKeepTheStiffnessAndAreNotWorthATryWhereTheyAreLarge) {
  Model model = plain_model();
  model.materials[1] = solve::Material{.poisson_ratio = 0.4, .law = Law::ogden, .ogden = {{842, -4.7}, {100, 2}}};
  const solve::Material before = model.materials[1];
  SolveOptions options = cheapest();
  EXPECT_NE(cheaper_models(model, options, 1.2).at(0).not_tried.find("the largest stretch was 1.2"), std::string::npos);
  EXPECT_EQ(only(model, options, 1.05).not_tried, "");
  EXPECT_EQ(model.materials[1].law, Law::linear_elastic);
  EXPECT_NEAR(solve::shear_modulus(model.materials[1]), solve::shear_modulus(before), 1e-9);
  EXPECT_NEAR(solve::bulk_modulus(model.materials[1]), solve::bulk_modulus(before), 1e-9);
}

}  // namespace brainshift::pipelines::cheaper_models_test
