// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::imposition_test {

/// Both forms of the essential conditions on one model, at rest.
struct BothForms {
  SolveResult exact, simplified;

  explicit BothForms(const Model& model) {
    SolveOptions options;
    options.tolerance = 1e-3;
    exact = solve(model, options);
    options.imposition = Imposition::simplified;
    simplified = solve(model, options);
  }
};

/// Largest |u − ū| over the conditions, mm.
double miss(const Model& model, const Solution& solution) {
  const auto& prescribed = model.conditions.displacement.array();
  return prescribed.isNaN().select(0.0, (solution.displacement.array() - prescribed).abs()).maxCoeff();
}

void expect_agreement(const Model& model, double imposed) {
  const BothForms forms(model);
  ASSERT_TRUE(forms.exact.measures.converged) << forms.exact.failure;
  ASSERT_TRUE(forms.simplified.measures.converged) << forms.simplified.failure;
  EXPECT_LE(miss(model, forms.exact.solution), 1e-9);
  const double missed = miss(model, forms.simplified.solution);
  testing::Test::RecordProperty("miss", std::to_string(missed / imposed));
  EXPECT_LE(missed, 0.01 * imposed);
  EXPECT_GT(missed, 1e-9);  // it is another form
  EXPECT_NEAR(forms.simplified.measures.constraint_error, missed, 1e-9);
  const Eigen::Vector3d expected = forms.exact.history.back().reaction;
  const Eigen::Vector3d reaction = forms.simplified.history.back().reaction;
  testing::Test::RecordProperty("reaction", std::to_string((reaction - expected).norm() / expected.norm()));
  EXPECT_LE((reaction - expected).norm(), 0.02 * expected.norm());
}

TEST(SimplifiedImposition, StretchesACubeAsTheExactFormDoes) {
  expect_agreement(uniaxial(1.2), 0.2 * model_side);
}

TEST(SimplifiedImposition, IndentsACubeAsTheExactFormDoes) {
  Model model = uniaxial(1);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const Eigen::RowVector3d x = model.cloud.positions.row(a);
    auto prescribed = model.conditions.displacement.row(a);
    if (x[2] > model_side - 1e-9) {  // a punch over a third of the top
      prescribed[2] = (x.head<2>().array() - model_side / 2).abs().maxCoeff() < model_side / 5 ? -4 : std::nan("");
    }
  }
  expect_agreement(model, 4);
}

}  // namespace brainshift::solve::imposition_test
