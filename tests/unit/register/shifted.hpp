// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "register/warp/point_mover.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::builders {

inline const Eigen::Vector3d shift(1.5, -2, 3);  // mm, LPS

/// A folder and a field that shifts all in its image.
class Shifted : public ::testing::Test {
 protected:
  test::ScratchFolder folder_;
  VectorImage field_ = field(grid({12, 12, 12}, {4, 4, 4}, oblique()), [](const Eigen::Vector3d&) { return shift; });
  PointMover mover_{field_};
};

}  // namespace brainshift::registration::builders
