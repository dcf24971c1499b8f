// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_mesh.hpp"

#include <gtest/gtest.h>

#include "register/files/byte_order.hpp"
#include "tests/unit/register/shifted.hpp"

namespace brainshift::registration::warp_mesh_test {

using namespace builders;

class WarpMesh : public Shifted {
 protected:
  std::string warped(const std::string& name, const std::string& text) {
    const auto warp = name.ends_with(".obj") ? warp_obj : warp_ply;
    warp(folder_.write(name, text), mover_, folder_ / ("warped_" + name));
    return test::bytes_of(folder_ / ("warped_" + name));
  }
  std::string refused(const std::string& name, const std::string& text) {
    const std::string said = test::refusal([&] { warped(name, text); });
    EXPECT_FALSE(std::filesystem::exists(folder_ / ("warped_" + name))) << said;
    return said;
  }
};

std::string ply(const std::string& format, const std::string& number, const std::string& data) {
  return "ply\nformat " + format + " 1.0\ncomment of a scanner\nelement vertex 2\nproperty uchar red\nproperty " +
         number + " x\nproperty " + number + " y\nproperty " + number +
         " z\nproperty float quality\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n" + data;
}

template <class Number>
std::string binary_vertices(bool swapped, const Eigen::Vector3d& u) {
  std::string bytes;
  const auto append = [&](auto value) {
    value = swapped ? with_bytes_swapped(value) : value;
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (const double z : {8.0, 9.0}) {
    append(static_cast<char>(200));
    append(static_cast<Number>(3 + u[0]));
    append(static_cast<Number>(-5 + u[1]));
    append(static_cast<Number>(z + u[2]));
    append(0.25F);
  }
  return bytes;
}

TEST_F(WarpMesh, AnObjKeepsEveryOtherLine) {
  EXPECT_EQ(warped("a.obj", "# made\r\nmtllib a.mtl\nv 3 -5 8 0.1 0.2 0.3\nv 500 0.50 0\nvn 0 0 1\nl 1 2\n"),
            "# made\r\nmtllib a.mtl\nv 4.5 -7 11 0.1 0.2 0.3\nv 500 0.50 0\nvn 0 0 1\nl 1 2\n");
  EXPECT_EQ(warped("ras.obj", "# SPACE=RAS\nv -3 5 8"), "# SPACE=RAS\nv -4.5 7 11");
}

TEST_F(WarpMesh, APlyOfWholeNumbersIsRefused) {
  const std::string text = ply("ascii", "int", "200 3 -5 8 0.25\n7 500 0 0 1\n");
  EXPECT_NE(test::refusal([&] { warped("a.ply", text); }).find("float or double"), std::string::npos);
}

TEST_F(WarpMesh, APlyKeepsPropertiesAndElementsWithoutAFace) {
  EXPECT_EQ(warped("a.ply", ply("ascii", "float", "200 3 -5 8 0.25\n7 500 0 0 1\n")),
            ply("ascii", "float", "200 4.5 -7 11 0.25\n7 500 0 0 1\n"));
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  for (const bool big : {false, true}) {
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    EXPECT_EQ(warped("f.ply", ply(format, "float", binary_vertices<float>(big, none))),
              ply(format, "float", binary_vertices<float>(big, shift)));
    EXPECT_EQ(warped("d.ply", ply(format, "double", binary_vertices<double>(big, none))),
              ply(format, "double", binary_vertices<double>(big, shift)));
  }
}

TEST_F(WarpMesh, WhatGoesAlongWithThePointsOfAPlyAreProperties) {
  PointMover mover(field_, heights);
  const auto with_values = [&](const std::string& text) {
    warp_ply(folder_.write("v.ply", text), mover, folder_ / "out.ply");
    return test::bytes_of(folder_ / "out.ply");
  };
  const auto expected = [](std::string text) {
    return text.insert(text.find("element face"), "property float estimated_error\nproperty float uncertainty\n");
  };
  EXPECT_EQ(with_values(ply("ascii", "float", "200 3 -5 8 0.25\r\n7 500 0 0 1\n")),
            expected(ply("ascii", "float", "200 4.5 -7 11 0.25 8 16\r\n7 500 0 0 1 0 0\n")));
  for (const bool big : {false, true}) {
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    std::string rows = binary_vertices<float>(big, shift);
    const auto number = [&](float value) {
      value = big ? with_bytes_swapped(value) : value;
      return std::string(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    rows = rows.substr(0, 17) + number(8) + number(16) + rows.substr(17) + number(9) + number(18);
    EXPECT_EQ(with_values(ply(format, "float", binary_vertices<float>(big, Eigen::Vector3d::Zero()))),
              expected(ply(format, "float", rows)));
  }
}

TEST_F(WarpMesh, RefusesWhatItCannotReadAndLeavesNothing) {
  EXPECT_NE(refused("text.obj", "nothing\n").find("text.obj: holds no vertex"), std::string::npos);
  EXPECT_NE(refused("short.obj", "v 1 2\n").find("short.obj:1"), std::string::npos);
  EXPECT_NE(refused("word.obj", "o a\nv 1 two 3\n").find("word.obj:2"), std::string::npos);
  EXPECT_NE(refused("text.ply", "nothing\n").find("text.ply: is no .ply"), std::string::npos);
  EXPECT_NE(refused("cut.ply", ply("ascii", "float", "200 3 -5 8")).find("cut.ply: ends before"), std::string::npos);
  EXPECT_NE(
      refused("whole.ply", ply("binary_little_endian", "int", binary_vertices<float>(false, shift))).find("float"),
      std::string::npos);
}

}  // namespace brainshift::registration::warp_mesh_test
