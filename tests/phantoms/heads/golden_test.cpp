// SPDX-License-Identifier: GPL-3.0-or-later
//
// A whole run of the synthetic head against what physics says of it. No number here was copied from a run.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "register/field/nodal_values.hpp"
#include "register/registration.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/segment.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/phantoms/heads/head_runs.hpp"
#include "tests/phantoms/program.hpp"

namespace brainshift {
namespace {

using Eigen::Vector3d;

std::map<std::string, Vector3d> landmark_shifts(const HeadRun& run) {
  const VectorImage forward = read_vector_image(run.folder / "register/preop_to_intraop.nii.gz");
  std::map<std::string, Vector3d> shifts;
  for (const auto& landmark : run.phantom.landmarks) {
    const Points place = landmark.position.transpose();
    shifts[landmark.name] = (registration::move_points(forward, place) - place).transpose();
  }
  return shifts;
}

TEST(Golden, EveryMeasureIsWithinItsBound) {
  const HeadRun& run = oblique_run();
  EXPECT_LE(run.measure("solve", "constraint_error_mm"), 0.05);
  EXPECT_LE(run.measure("solve", "largest_penetration_mm"), 0.5);
  EXPECT_GT(run.measure("solve", "smallest_jacobian"), 0);
  EXPECT_GT(run.measure("register", "jacobian_min"), 0);
  EXPECT_LE(run.measure("register", "inverse_mean_mm"), 0.05);
  EXPECT_LE(run.measure("register", "inverse_999_mm"), 0.5);
}

// Four mm under the cortex tissue goes where the cortex goes, a little less.
TEST(Golden, TissueUnderTheOpeningFollowsTheCortex) {
  const HeadRun& run = oblique_run();
  const pipelines::Opening& opening = run.phantom.opening;
  const Vector3d shift = landmark_shifts(run).at("cortex");
  EXPECT_GT(shift.norm(), 0.75 * opening.depth);
  EXPECT_LT(shift.norm(), 1.05 * opening.depth);
  EXPECT_GT(-shift.normalized().dot(opening.normal), std::cos(15 * std::numbers::pi / 180));
}

// The shift dies away with depth, and the far side, which the skull holds, hardly moves.
TEST(Golden, TheShiftDiesAwayWithTheDistanceFromTheOpening) {
  const HeadRun& run = oblique_run();
  const auto shifts = landmark_shifts(run);
  EXPECT_GT(shifts.at("cortex").norm(), shifts.at("tumour").norm());
  EXPECT_GT(shifts.at("tumour").norm(), shifts.at("deep").norm());
  EXPECT_GT(shifts.at("deep").norm(), shifts.at("opposite").norm());
  EXPECT_LT(shifts.at("opposite").norm(), 0.15 * run.phantom.opening.depth);
}

// Mean volume ratio of a tissue, from the Jacobian image.
double volume_ratio(const ScalarImage& jacobian, const LabelMap& labels, std::uint16_t label) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    if (labels.voxels[i] == label) {
      sum += static_cast<double>(jacobian.voxels[i]);
      ++count;
    }
  }
  return sum / static_cast<double>(count);
}

// At ν = 0.49 the bulk modulus is 50 times the shear modulus: strains of some 10 % change the volume by a fifth of a
// percent. The ventricles, two thousand times softer, give way instead.
TEST(Golden, ParenchymaKeepsItsVolumeAndTheVentriclesGiveWay) {
  const HeadRun& run = oblique_run();
  const ScalarImage jacobian = read_image(run.folder / "register/jacobian.nii.gz");
  const LabelMap labels = read_label_map(run.folder / "segment/labels.nii.gz");
  const double parenchyma = volume_ratio(jacobian, labels, segmentation::default_label::parenchyma);
  const double ventricles = volume_ratio(jacobian, labels, segmentation::default_label::ventricles);
  EXPECT_NEAR(parenchyma, 1, 0.01);
  EXPECT_LT(ventricles, parenchyma - 0.02);
}

// Divergence theorem: the integral of J - 1 over the brain is what its moved surface encloses less than before. Two
// roads to one number: the voxels' Jacobian on one, the nodes' displacement on the other.
TEST(Golden, TheJacobianAccountsForTheVolumeThatTheSurfaceLoses) {
  const HeadRun& run = oblique_run();
  const ScalarImage jacobian = read_image(run.folder / "register/jacobian.nii.gz");
  const LabelMap labels = read_label_map(run.folder / "segment/labels.nii.gz");
  double lost_inside = 0;
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    if (labels.voxels[i] >= 1 && labels.voxels[i] <= 3) {
      lost_inside += (1 - static_cast<double>(jacobian.voxels[i])) * labels.geometry.voxel_volume();
    }
  }
  const Surface before = read_surface(run.folder / "segment/brain.vtp");
  const Solution solution = read_solution(run.folder / "solve/solution.vtu");
  const Points moved = registration::nodal_values_at(solution, solution.displacement, false, before.vertices);
  const Surface after{before.vertices + moved, before.triangles};
  const double lost_outside = volume(before) - volume(after);
  EXPECT_GT(lost_outside, 0);
  // half a voxel's thickness of surface voxels, under the opening, at the strain there (some 10 %)
  const double opening = std::numbers::pi * std::pow(run.phantom.opening.radius, 2);
  EXPECT_NEAR(lost_inside, lost_outside, 0.1 * lost_outside + 0.1 * 2.0 * opening);
}

// The opening's forces pay for the strain energy and for what the damping takes: they cannot get more out than they
// put in.
TEST(Golden, StrainEnergyIsPaidForByExternalWork) {
  const auto history = read_table(oblique_run().folder / "solve/history.csv");
  ASSERT_FALSE(history.empty());
  const double work = history.back().at("external_work_mJ");
  EXPECT_GT(work, 0);
  for (const auto& row : history) {
    const bool rests = row.at("step") > 20;  // before, the fastest motion is hardly seen at whole steps
    EXPECT_NEAR(row.at("strain_energy_mJ") + row.at("kinetic_energy_mJ") + row.at("dissipated_energy_mJ"),
                row.at("external_work_mJ"), (rests ? 0.01 : 0.05) * work)
        << "at step " << row.at("step");
  }
}

}  // namespace
}  // namespace brainshift
