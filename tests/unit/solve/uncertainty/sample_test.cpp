// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/uncertainty/sample.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "solve/uncertainty/draw.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::sample_test {

using test::refusal;

TEST(SampledDisplacements, NarrowsAsThePoissonsRatioSays) {
  SolveOptions options;
  options.shape.basis = Basis::linear;
  options.tolerance = 0.002;
  for (const double ratio : {0.3, 0.4}) {
    Model model = uniaxial(1.1);
    model.materials[1].poisson_ratio = ratio;
    const auto moved =
        sampled_displacements(model, options, std::vector{Constants{.materials = model.materials}}).front();
    ASSERT_TRUE(moved);
    const double narrower = 1 - uniaxial_answer(model.materials[1], 1.1).second;
    EXPECT_NEAR(-moved->col(0).minCoeff() / model_side, narrower, 0.02 * narrower);
  }
}

TEST(SampledDisplacements, IsRefusedWithWhatSamplesDoNotGoWith) {
  SolveOptions options;
  options.dynamics = Dynamics::transient;
  EXPECT_NE(refusal([&] { sampled_displacements(uniaxial(1.1, 4), options, {}); }).find("motion in time"),
            std::string::npos);
  Model resected = uniaxial(1.1, 4);
  resected.resection.emplace();
  EXPECT_NE(refusal([&] { sampled_displacements(resected, {}, {}); }).find("a resection"), std::string::npos);
}

TEST(SpreadAbout, IsTheMeanProductOfTheDifferences) {
  Points answer(2, 3), one(2, 3), two(2, 3);
  answer << 1, 1, 1, 0, 0, 0;
  one << 3, 1, 1, 0, 0, 0;
  two << 1, 2, 4, 0, 0, 0;
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(2, 6);
  expected.row(0) << 2, 0.5, 4.5, 0, 1.5, 0;
  EXPECT_LT((spread_about(answer, {one, two}) - expected).norm(), 1e-12);
  EXPECT_EQ(spread_about(answer, {}).norm(), 0);
}

}  // namespace brainshift::solve::sample_test
