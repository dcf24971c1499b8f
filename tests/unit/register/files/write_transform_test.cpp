// SPDX-License-Identifier: GPL-3.0-or-later
// ITK brings an Eigen of its own, which must be read before ours.
#include <gtest/gtest.h>

#include "register/files/write_transform.hpp"
#include "segmentation/image/itk_bridge.hpp"
#include "tests/unit/file_size_limit.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/register/read_transform.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::write_transform_test {

using namespace builders;
using test::FileSizeLimit;
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

TEST(WriteTransform, MovesAPlaceAlikeDeflatedAndPlain) {
  const ScratchFolder folder;
  const auto moving = field(grid(), [](const Eigen::Vector3d& x) { return Eigen::Vector3d(std::sin(x[0]), 1, x[2]); });
  write_transform(folder / "deflated.h5", moving);
  write_transform(folder / "plain.h5", moving, Packing::plain);
  const double x[3] = {1.3, 2.2, 3.1};
  const auto one = read_transform(folder / "deflated.h5")->TransformPoint(x);
  const auto other = read_transform(folder / "plain.h5")->TransformPoint(x);
  EXPECT_EQ(one, other);
  EXPECT_GT(one[1], x[1]);
}

TEST(WriteTransform, ThatFindsNoRoomSaysSoAndHarmsNoLaterOne) {
  const ScratchFolder folder;
  const auto file = folder / "field.h5";
  const auto moving = field(grid(), [](const Eigen::Vector3d& x) { return Eigen::Vector3d(std::sin(x[0]), 1, x[2]); });
  for (const rlim_t room : {0, 100, 1000, 4000, 8000}) {
    const FileSizeLimit limit(room);
    EXPECT_THROW(write_transform(file, moving), std::runtime_error) << room;
  }
  write_transform(file, moving);
  EXPECT_NO_THROW(read_transform(file));
}

}  // namespace brainshift::registration::write_transform_test
