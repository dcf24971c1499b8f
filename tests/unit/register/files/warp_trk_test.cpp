// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstring>

#include "register/files/byte_order.hpp"
#include "register/files/trk_header.hpp"
#include "register/files/warp_tracts.hpp"
#include "tests/unit/register/shifted.hpp"

namespace brainshift::registration::warp_trk_test {

using namespace builders;

/// A file of TrackVis in one order of bytes.
struct Trk {
  bool swapped = false;
  std::string bytes = std::string(trk_header_size, '\0');

  template <class Number>
  void put(std::size_t place, Number value) {
    value = swapped ? with_bytes_swapped(value) : value;
    std::memcpy(bytes.data() + place, &value, sizeof(value));
  }
  template <class Number>
  void append(Number value) {
    value = swapped ? with_bytes_swapped(value) : value;
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
};

/// Voxels of 2 mm whose axes run to L, A and S: RAS = (40 - 2i, 2j - 30, 2k - 20).
Trk head(bool swapped, const std::string& order) {
  Trk trk{.swapped = swapped};
  std::memcpy(trk.bytes.data(), "TRACK", 5);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    trk.put(6 + 2 * axis, static_cast<std::int16_t>(40));
    trk.put(12 + 4 * axis, 2.0F);
  }
  trk.put(36, std::int16_t{1});   // scalars
  trk.put(238, std::int16_t{2});  // properties
  const std::array<float, 16> matrix = {-2, 0, 0, 40, 0, 2, 0, -30, 0, 0, 2, -20, 0, 0, 0, 1};
  for (std::size_t i = 0; i < 16; ++i) {
    trk.put(440 + 4 * i, matrix[i]);
  }
  std::memcpy(trk.bytes.data() + 948, order.data(), order.size());
  trk.put(988, std::int32_t{1});
  trk.put(992, std::int32_t{2});
  trk.put(996, std::int32_t{1000});
  return trk;
}

/// One tract of two points near the brain's middle, moved by u in LPS.
std::string tract(bool swapped, const Eigen::Vector3f& u) {
  Trk trk = head(swapped, "LAS");
  trk.append(std::int32_t{2});
  for (const float z : {29.0F, 30.0F}) {
    // A voxel's corner is its centre less half a voxel: LPS (3, -5, z - 21).
    trk.append(44.0F + u.x());
    trk.append(36.0F - u.y());
    trk.append(z + u.z());
    trk.append(0.25F);
  }
  trk.append(7.0F);
  trk.append(8.0F);
  return trk.bytes;
}

class WarpTrk : public Shifted {
 protected:
  std::string warped(const std::string& text) {
    warp_trk(folder_.write("in.trk", text), mover_, folder_ / "out.trk");
    return test::bytes_of(folder_ / "out.trk");
  }
  std::string refused(const std::string& text) {
    const std::string said =
        test::refusal([&] { warp_trk(folder_.write("in.trk", text), mover_, folder_ / "out.trk"); });
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.trk")) << said;
    return said;
  }
};

TEST_F(WarpTrk, MovesPointsAndKeepsHeaderScalarsAndPropertiesByteForByte) {
  for (const bool swapped : {false, true}) {
    EXPECT_EQ(warped(tract(swapped, Eigen::Vector3f::Zero())), tract(swapped, shift.cast<float>()));
  }
  EXPECT_EQ(mover_.moved().outside, 0U);
}

TEST_F(WarpTrk, WhatGoesAlongWithItsPointsAreScalarsBehindTheirs) {
  PointMover mover(field_, heights);
  for (const bool swapped : {false, true}) {
    warp_trk(folder_.write("in.trk", tract(swapped, Eigen::Vector3f::Zero())), mover, folder_ / "out.trk");
    Trk expected{.swapped = swapped, .bytes = tract(swapped, shift.cast<float>()).substr(0, trk_header_size)};
    expected.put(36, std::int16_t{3});
    expected.bytes.replace(58, 15, "estimated_error").replace(78, 11, "uncertainty");
    expected.append(std::int32_t{2});
    for (const float z : {29.0F, 30.0F}) {
      for (const float value : {45.5F, 38.0F, z + 3, 0.25F, z - 21, 2 * (z - 21)}) {
        expected.append(value);
      }
    }
    expected.append(7.0F);
    expected.append(8.0F);
    EXPECT_EQ(test::bytes_of(folder_ / "out.trk"), expected.bytes) << swapped;
  }
}

TEST_F(WarpTrk, AHeaderWithItsTenScalarsStaysAsItIs) {
  TrkBytes bytes{};
  const TrkHeader full{.scalars = 10, .to_lps = Eigen::Affine3d::Identity()};
  EXPECT_EQ(add_scalars(bytes, full, heights(Points(0, 3))), 0);
  EXPECT_EQ(bytes, TrkBytes{});
}

TEST_F(WarpTrk, TheVoxelOrderOfTheHeaderCountsAsInTrackVis) {
  const auto place = [&](const std::string& order) {
    TrkBytes bytes{};
    std::memcpy(bytes.data(), head(false, order).bytes.data(), bytes.size());
    return Eigen::Vector3d(read_trk_header("in.trk", bytes).to_lps * Eigen::Vector3d(11, 5, 7));
  };
  EXPECT_LT((place("LAS") - Eigen::Vector3d(-30, 26, -14)).norm(), 1e-9);
  // Indices (5, 2, 3) along R, A and S are (34, 2, 3) along L, A and S.
  EXPECT_LT((place("RAS") - Eigen::Vector3d(28, 26, -14)).norm(), 1e-9);
  EXPECT_LT((place("ALS") - Eigen::Vector3d(-36, 20, -14)).norm(), 1e-9);
}

TEST_F(WarpTrk, RefusesWhatItCannotReadAndLeavesNothing) {
  const std::string whole = tract(false, Eigen::Vector3f::Zero());
  EXPECT_NE(refused(whole.substr(0, 500)).find("in.trk: is no TrackVis file: it ends within"), std::string::npos);
  EXPECT_NE(refused("RACK" + whole.substr(4)).find("is no TrackVis file"), std::string::npos);
  EXPECT_NE(refused(whole.substr(0, whole.size() - 4)).find("truncated"), std::string::npos);
  EXPECT_NE(refused(whole.substr(0, 1000)).find("promises 1 tracts, the file holds 0"), std::string::npos);
  Trk no_place = head(false, "LAS");
  no_place.put(500, 0.0F);
  EXPECT_NE(refused(no_place.bytes).find("vox_to_ras"), std::string::npos);
  EXPECT_NE(refused(head(false, "LLS").bytes).find("voxel order is \"LLS\""), std::string::npos);
}

}  // namespace brainshift::registration::warp_trk_test
