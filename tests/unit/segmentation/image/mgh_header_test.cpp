// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>

#include "segmentation/image/frame_note.hpp"
#include "segmentation/image/gzip_file.hpp"
#include "segmentation/image/image.hpp"
#include "segmentation/image/image_header.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::mgh_header_test {

// The highest byte first.
template <class T>
void put(std::string& bytes, std::size_t place, T value) {
  std::memcpy(bytes.data() + place, &value, sizeof(T));
  if (std::endian::native == std::endian::little) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(place),
                 bytes.begin() + static_cast<std::ptrdiff_t>(place + sizeof(T)));
  }
}

/// 2 x 3 x 4 voxels of 1 x 2 x 3 mm, coronal as FreeSurfer's; voxel i holds `1000 + i`.
std::string mgh_bytes(int type = 4) {
  std::string bytes(284 + 24 * 4, '\0');
  int place = 0;
  for (const int value : {1, 2, 3, 4, 1, type, 0}) {
    put<std::int32_t>(bytes, static_cast<std::size_t>(place), value);
    place += 4;
  }
  put<std::int16_t>(bytes, 28, 1);
  const float frame[] = {1, 2, 3, -1, 0, 0, 0, 0, -1, 0, 1, 0, 10, 20, 30};
  for (std::size_t i = 0; i < std::size(frame); ++i) {
    put<float>(bytes, 30 + 4 * i, frame[i]);
  }
  for (std::size_t i = 0; i < 24; ++i) {
    if (type == 4) {
      put<std::int16_t>(bytes, 284 + 2 * i, static_cast<std::int16_t>(1000 + i));
    } else if (type == 3) {
      put<float>(bytes, 284 + 4 * i, static_cast<float>(1000 + i) + 0.5F);
    } else if (type == 1) {
      put<std::int32_t>(bytes, 284 + 4 * i, static_cast<std::int32_t>(1000 + i));
    } else {
      bytes[284 + i] = static_cast<char>(i);
    }
  }
  return bytes;
}

class MghFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& bytes, const std::string& name = "a.mgh") const {
    std::ofstream(scratch_.path() / name, std::ios::binary) << bytes;
    return scratch_.path() / name;
  }
  ScratchFolder scratch_;
};

TEST_F(MghFile, HasFreeSurfersFrameInLps) {
  const LabelMap map = read_label_map(write(mgh_bytes()));
  EXPECT_TRUE((map.geometry.size == Eigen::Array3i(2, 3, 4)).all());
  EXPECT_TRUE(map.geometry.spacing.isApprox(Eigen::Vector3d(1, 2, 3)));
  // The voxel of half the size lies at the header's centre, (10, 20, 30) in RAS.
  EXPECT_TRUE(map.geometry.to_world({1, 1.5, 2}).isApprox(Eigen::Vector3d(-10, -20, 30), 1e-9));
  EXPECT_TRUE(map.geometry.direction.col(0).isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_TRUE(map.geometry.direction.col(1).isApprox(Eigen::Vector3d(0, 0, -1)));
  EXPECT_TRUE(map.geometry.direction.col(2).isApprox(Eigen::Vector3d(0, -1, 0)));
  EXPECT_EQ(map.at(1, 2, 3), 1023);
  EXPECT_EQ(map.at(1, 0, 0), 1001);
}

TEST_F(MghFile, WithoutAFrameIsCoronalInMillimetres) {
  std::string bytes = mgh_bytes();
  put<std::int16_t>(bytes, 28, 0);
  const LabelMap map = read_label_map(write(bytes));
  EXPECT_TRUE(map.geometry.spacing.isApprox(Eigen::Vector3d::Ones()));
  EXPECT_TRUE(map.geometry.direction.col(1).isApprox(Eigen::Vector3d(0, 0, -1)));
  EXPECT_NE(frame_note(scratch_ / "a.mgh").find("goodRASFlag is not set"), std::string::npos);
  EXPECT_EQ(frame_note(write(mgh_bytes(), "b.mgh")), "");
}

TEST_F(MghFile, EveryTypeIsReadCompressedOrNot) {
  EXPECT_EQ(read_image(write(mgh_bytes(3))).at(1, 0, 0), 1001.5F);
  EXPECT_EQ(read_image(write(mgh_bytes(1))).at(1, 0, 0), 1001.0F);
  EXPECT_EQ(read_image(write(mgh_bytes(0))).at(1, 2, 3), 23.0F);
  const auto plain = write(mgh_bytes(), "plain");
  write_gzip(scratch_.path() / "b.mgz", plain);
  EXPECT_EQ(read_label_map(scratch_.path() / "b.mgz").at(1, 2, 3), 1023);
}

TEST_F(MghFile, WhatCannotBeIsRefused) {
  const auto refused = [](const std::filesystem::path& file, const std::vector<std::string>& words) {
    return throws_saying<std::invalid_argument>([&] { read_label_map(file); }, words);
  };
  const auto changed = [&](std::size_t place, int value) {
    std::string bytes = mgh_bytes();
    put<std::int32_t>(bytes, place, value);
    return write(bytes);
  };
  EXPECT_TRUE(refused(changed(0, 2), {"a.mgh", "no FreeSurfer image"}));
  EXPECT_TRUE(refused(changed(4, 0), {"0 voxels along an axis"}));
  EXPECT_TRUE(refused(changed(4, 1 << 30), {"more than"}));
  EXPECT_TRUE(refused(changed(16, 2), {"one 3-D volume", "2 x 3 x 4 x 2"}));
  EXPECT_TRUE(refused(changed(20, 7), {"type 7"}));
  EXPECT_TRUE(refused(write(mgh_bytes().substr(0, 300)), {"truncated", "48 bytes", "16"}));
  EXPECT_TRUE(refused(write(mgh_bytes().substr(0, 100)), {"truncated within the header"}));
  std::string sheared = mgh_bytes();
  put<float>(sheared, 42, -0.5F);
  EXPECT_TRUE(refused(write(sheared), {"right angles"}));
  std::string infinite = mgh_bytes();
  put<float>(infinite, 78, INFINITY);
  EXPECT_TRUE(refused(write(infinite), {"not finite"}));
  EXPECT_TRUE(throws_saying<std::exception>([&] { write_image(scratch_.path() / "c.mgz", ScalarImage{}); }, {}));
}

}  // namespace brainshift::test::mgh_header_test
