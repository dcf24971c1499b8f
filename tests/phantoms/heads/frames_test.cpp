// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "register/registration.hpp"
#include "register/warp/warp.hpp"
#include "tests/phantoms/heads/head_runs.hpp"

namespace brainshift {
namespace {

Points shifts_at(const HeadRun& run, const Points& places) {
  const VectorImage forward = read_vector_image(run.folder / "register/preop_to_intraop.nii.gz");
  return registration::move_points(forward, places) - places;
}

// The voxels sample the head at other places, so surface and cloud differ: by a fraction of a voxel (4 mm), and the
// shift with them. A frame mistaken anywhere would move the head by centimetres, or turn the shift round.
TEST(Frames, TheSameHeadInTwoFramesShiftsTheSameWayInTheWorld) {
  const HeadRun& oblique = oblique_run();
  const HeadRun& mirrored = mirrored_run();
  Points places(static_cast<Eigen::Index>(oblique.phantom.landmarks.size()), 3);
  for (std::size_t i = 0; i < oblique.phantom.landmarks.size(); ++i) {
    places.row(static_cast<Eigen::Index>(i)) = oblique.phantom.landmarks[i].position.transpose();
  }
  const Points a = shifts_at(oblique, places);
  const Points b = shifts_at(mirrored, places);
  const double depth = oblique.phantom.opening.depth;
  EXPECT_GT(a.rowwise().norm().maxCoeff(), 0.5 * depth);
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    EXPECT_LT((a - b).row(i).norm(), 0.1 * depth) << oblique.phantom.landmarks[static_cast<std::size_t>(i)].name;
  }
}

}  // namespace
}  // namespace brainshift
