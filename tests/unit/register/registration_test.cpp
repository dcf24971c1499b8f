// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/registration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "register/field/resampling_field.hpp"
#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::registration_test {

using namespace builders;

/// The sentence that the input's fault is refused with; fails when it is not.
std::string refusal(const RegisterInput& input, const RegisterOptions& options = {}) {
  try {
    register_images(input, options);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

class RegisterImages : public ::testing::Test {
 protected:
  RegisterInput input = head(sinking, grid({28, 25, 24}, {3.2, 3.6, 4.0}));
};

TEST_F(RegisterImages, RefusesLabelsOnAnotherGrid) {
  input.labels->geometry.origin.x() += 1;
  EXPECT_NE(refusal(input).find("same grid"), std::string::npos);
}

TEST_F(RegisterImages, RefusesAnOpenSurface) {
  input.brain.triangles.conservativeResize(input.brain.triangles.rows() - 1, 3);
  refusal(input);
}

TEST_F(RegisterImages, RefusesASurfaceThatDoesNotMeetTheImage) {
  input.brain.vertices.col(0).array() += 1000;
  EXPECT_NE(refusal(input).find("encloses no voxel"), std::string::npos);
}

TEST_F(RegisterImages, RefusesAFadeNarrowerThanAVoxel) {
  for (const double fade : {0.0, -1.0, 5.0, std::numeric_limits<double>::quiet_NaN()}) {
    RegisterOptions options;
    options.fade = fade;
    EXPECT_NE(refusal(input, options).find("fade"), std::string::npos);
  }
}

TEST_F(RegisterImages, RefusesASolutionThatIsNotFinite) {
  input.solution.displacement(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(input).find("finite"), std::string::npos);
}

TEST_F(RegisterImages, RefusesALandmarkThatIsNotFinite) {
  input.landmarks = Points::Constant(1, 3, std::numeric_limits<double>::infinity());
  EXPECT_NE(refusal(input).find("landmark"), std::string::npos);
}

TEST_F(RegisterImages, RefusesATolerancOfZero) {
  RegisterOptions options;
  options.inverse_tolerance = 0;
  refusal(input, options);
}

TEST_F(RegisterImages, InvertsTheFieldAsFarAsItIsTold) {
  RegisterOptions loosely, closely;
  loosely.inverse_tolerance = 1;
  closely.inverse_tolerance = 1e-4;
  const Registration far = register_images(input, loosely), near = register_images(input, closely);
  double most = 0;
  for (std::size_t v = 0; v < near.resampling.voxels.size(); ++v) {
    most = std::max(most, (at(far.resampling, v) - at(near.resampling, v)).norm());
  }
  EXPECT_GT(most, 0.01) << "the field between voxels hides it in the measures";
  EXPECT_LT(most, 1.1);
}

TEST_F(RegisterImages, CountsTheVoxelsThatItDidNotInvert) {
  RegisterOptions options;
  options.inverse_tolerance = 1e-30;
  const Registration result = register_images(input, options);
  EXPECT_GT(result.measures.not_inverted, 0U);
  EXPECT_EQ(result.measures.not_inverted, resampling_field(result.forward, options.inverse_tolerance).not_inverted);
}

TEST_F(RegisterImages, DoesWithoutLabelsAndLandmarks) {
  input.labels.reset();
  const Registration result = register_images(input, {});
  EXPECT_FALSE(result.warped_labels.has_value());
  EXPECT_EQ(result.landmarks.rows(), 0);
}

TEST_F(RegisterImages, WithoutAnImageWarpsTheLabelsOnTheSameFields) {
  const Registration with = register_images(input, {});
  input.t1.voxels.clear();
  const Registration without = register_images(input, {});
  EXPECT_TRUE(without.warped.voxels.empty());
  EXPECT_EQ(without.warped_labels->voxels, with.warped_labels->voxels);
  EXPECT_EQ(without.forward.voxels, with.forward.voxels);
  input.labels.reset();
  EXPECT_THROW(register_images(input, {}), std::invalid_argument) << "there is nothing to warp";
}

TEST_F(RegisterImages, TellsOfLandmarksHowFarOffTheSolutionIsThere) {
  input.landmarks = Points{{0, 0, 0}, {5, 0, -10}, {0, 300, 0}};
  EXPECT_TRUE(register_images(input, {}).landmark_error.empty());
  input.solution.estimated_error.assign(static_cast<std::size_t>(input.solution.positions.rows()), 0.3);
  const Registration result = register_images(input, {});
  EXPECT_EQ(result.measures.landmarks_outside, 1U);
  const std::vector<double>& error = result.landmark_error;
  ASSERT_EQ(error.size(), static_cast<std::size_t>(input.landmarks.rows()));
  EXPECT_NEAR(error[0], 0.3, 1e-9);
  EXPECT_NEAR(error[1], 0.3, 1e-9);
  EXPECT_TRUE(std::isnan(error[2])) << "no node is near: nobody knows";
}

TEST_F(RegisterImages, KnowsALandmarksErrorFromWhereItLayBefore) {
  Eigen::Index node = 0;
  input.solution.displacement.rowwise().norm().maxCoeff(&node);
  const Eigen::VectorXd heights = input.solution.positions.col(2).array() + 100;
  input.solution.estimated_error.assign(heights.begin(), heights.end());
  input.landmarks = input.solution.positions.row(node);
  EXPECT_NEAR(register_images(input, {}).landmark_error.at(0), heights[node], 1e-6);
}

TEST_F(RegisterImages, ReportsProgressThatGrowsToOne) {
  double last = 0;
  register_images(input, {}, [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, last);
    last = fraction;
  });
  EXPECT_EQ(last, 1);
}

TEST_F(RegisterImages, WorksWhereTheBrainReachesTheImagesBorder) {
  ImageGeometry& g = input.t1.geometry;
  g.origin.z() += 30;  // the image begins inside the brain
  input.labels->geometry = g;
  const Registration result = register_images(input, {});
  EXPECT_EQ(result.measures.not_inverted, 0U);
  EXPECT_GT(result.measures.brain_voxels, 100U);
  EXPECT_LE(result.measures.inverse_mean, 0.05);
}

}  // namespace brainshift::registration::registration_test
