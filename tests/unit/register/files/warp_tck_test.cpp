// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>

#include "register/files/byte_order.hpp"
#include "register/files/warp_tracts.hpp"
#include "tests/unit/register/shifted.hpp"

namespace brainshift::registration::warp_tck_test {

using namespace builders;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers as they stand in the file.
template <class Number>
std::string bytes_of_numbers(const std::vector<double>& values, bool swapped) {
  std::string bytes;
  for (const double value : values) {
    std::array<Number, 1> number{static_cast<Number>(value)};
    swap_if(swapped, number);
    bytes.append(reinterpret_cast<const char*>(number.data()), sizeof(Number));
  }
  return bytes;
}

/// Two tracts in RAS, the last point of which lies outside the image.
std::vector<double> tracts(const Eigen::Vector3d& u) {
  return {-3 - u[0], 5 - u[1], 8 + u[2], -3 - u[0], 5 - u[1], 9 + u[2], nan, nan,      nan,      -4 - u[0], 5 - u[1],
          9 + u[2],  500,      0,        0,         nan,      nan,      nan, infinity, infinity, infinity};
}

std::string header(const std::string& datatype, const std::string& file = ". 128") {
  std::string text = "mrtrix tracks\ncommand_history: tckgen with: a colon\nstep_size: 0.5\ndatatype: " + datatype +
                     "\ncount: 2\nfile: " + file + "\nEND\n";
  text.resize(128, '\0');
  return text;
}

class WarpTck : public Shifted {
 protected:
  std::string warped(const std::string& text) {
    warp_tck(folder_.write("in.tck", text), mover_, folder_ / "out.tck");
    return test::bytes_of(folder_ / "out.tck");
  }
  std::string refused(const std::string& text) {
    const std::string said =
        test::refusal([&] { warp_tck(folder_.write("in.tck", text), mover_, folder_ / "out.tck"); });
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.tck")) << said;
    return said;
  }
};

TEST_F(WarpTck, MovesPointsOfEveryKindOfNumberAndKeepsAllElseByteForByte) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  for (const bool big : {false, true}) {
    const std::string order = big ? "BE" : "LE";
    EXPECT_EQ(warped(header("Float32" + order) + bytes_of_numbers<float>(tracts(none), big)),
              header("Float32" + order) + bytes_of_numbers<float>(tracts(shift), big));
    EXPECT_EQ(warped(header("Float64" + order) + bytes_of_numbers<double>(tracts(none), big)),
              header("Float64" + order) + bytes_of_numbers<double>(tracts(shift), big));
  }
  EXPECT_EQ(mover_.moved().points, 16U);
  EXPECT_EQ(mover_.moved().outside, 4U);
}

TEST_F(WarpTck, WhatGoesAlongWithItsPointsIsATrackScalarFile) {
  PointMover mover(field_, heights);
  warp_tck(
      folder_.write("in.tck", header("Float64BE") + bytes_of_numbers<double>(tracts(Eigen::Vector3d::Zero()), true)),
      mover, folder_ / "out.tck");
  const std::string text = test::bytes_of(folder_ / "uncertainty_out.tsf");
  const std::size_t numbers_at = std::stoul(text.substr(text.find("file: . ") + 8));
  EXPECT_TRUE(
      text.starts_with("mrtrix track scalars\ncommand_history: tckgen with: a colon\nstep_size: 0.5\ncount: 2\n"
                       "datatype: Float32LE\nfile: . "));
  EXPECT_NE(text.find("\nEND\n"), std::string::npos);
  // The height of each point before it moves, doubled; NaN behind a tract, infinity at the end.
  EXPECT_EQ(text.substr(numbers_at), bytes_of_numbers<float>({16, 18, nan, 18, 0, nan, infinity}, false));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "estimated_error_out.tsf"));
}

TEST_F(WarpTck, RefusesWhatItCannotReadAndLeavesNothing) {
  const std::string data = bytes_of_numbers<float>(tracts(Eigen::Vector3d::Zero()), false);
  EXPECT_NE(refused("something else\n").find("in.tck: is no MRtrix tract file"), std::string::npos);
  EXPECT_NE(refused(header("Float32LE").substr(0, 60)).find("END"), std::string::npos);
  EXPECT_NE(refused(header("Int16LE") + data).find("\"Int16LE\"; Float32LE"), std::string::npos);
  EXPECT_NE(refused(header("Float32LE", "other.dat 0") + data).find("END or the place"), std::string::npos);
  EXPECT_NE(refused(header("Float32LE", "other.dat 128") + data).find("another file"), std::string::npos);
  EXPECT_NE(refused(header("Float32LE") + data.substr(0, data.size() - 12)).find("truncated"), std::string::npos);
  EXPECT_NE(refused(header("Float32LE") + bytes_of_numbers<float>({1, nan, 2}, false)).find(" is not finite"),
            std::string::npos);
}

}  // namespace brainshift::registration::warp_tck_test
