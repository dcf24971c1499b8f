// SPDX-License-Identifier: GPL-3.0-or-later
// ITK brings an Eigen of its own, which must be read before ours.
#include <gtest/gtest.h>

#include "register/files/write_transform.hpp"
#include "segmentation/image/itk_bridge.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/register/read_transform.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::write_transform_test {

using namespace builders;
using test::ScratchFolder;

TEST(WriteTransform, OfAFieldThatIsZeroIsTheIdentity) {
  const ScratchFolder folder;
  write_transform(folder.path() / "zero.h5",
                  field(grid(), [](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); }));
  const auto transform = read_transform(folder.path() / "zero.h5");
  const double x[3] = {1, 2, 3};
  const auto moved = transform->TransformPoint(x);
  EXPECT_EQ(moved[0], 1);
  EXPECT_EQ(moved[2], 3);
}

}  // namespace brainshift::registration::write_transform_test
