// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/ply_claims.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::ply_claims_test {

using namespace std::string_literals;

std::string header(const std::string& format, int faces, const std::string& count) {
  return "ply\nformat " + format + " 1.0\ncomment SPACE=LPS\nelement vertex 1\nproperty float x\nproperty double y\n" +
         "element face " + std::to_string(faces) + "\nproperty list " + count + " int vertex_indices\nend_header\n";
}

std::string fault_of(const std::string& text) {
  const ScratchFolder folder;
  return refusal([&] { check_ply_claims(folder.write("a.ply", text)); });
}

const std::string vertex(12, '\0'), corners(12, '\1');

TEST(PlyClaims, OfAWholeFilePass) {
  EXPECT_EQ(fault_of(header("ascii", 2, "uchar") + "1 2\n3 0 1 2\n4 0 1 2 3\n"), "");
  EXPECT_EQ(fault_of(header("binary_little_endian", 1, "uchar") + vertex + "\3" + corners), "");
  EXPECT_EQ(fault_of(header("binary_little_endian", 1, "uint") + vertex + "\3\0\0\0"s + corners), "");
  EXPECT_EQ(fault_of(header("binary_big_endian", 1, "ushort") + vertex + "\0\3"s + corners), "");
}

TEST(PlyClaims, HandOutTheHeader) {
  const ScratchFolder folder;
  const PlyHeader read = check_ply_claims(folder.write("a.ply", header("ascii", 1, "uchar") + "1 2\n3 0 1 2\n"));
  EXPECT_EQ(read.format, "ascii");
  ASSERT_EQ(read.elements.size(), 2U);
  const PlyElement &vertices = read.elements[0], &faces = read.elements[1];
  EXPECT_TRUE(vertices.name == "vertex" && vertices.rows == 1 && faces.name == "face" && faces.rows == 1);
  ASSERT_TRUE(vertices.properties.size() == 2 && faces.properties.size() == 1);
  EXPECT_EQ(vertices.properties[1].name, "y");
  EXPECT_EQ(vertices.properties[1].type, "double");
  EXPECT_FALSE(vertices.properties[1].count_bytes);
  EXPECT_EQ(faces.properties[0].name, "vertex_indices");
  EXPECT_EQ(faces.properties[0].bytes, 4U);
  EXPECT_EQ(faces.properties[0].count_bytes, 1U);
}

TEST(PlyClaims, AHeaderThatIsNoneIsRefused) {
  std::string no_element = header("ascii", 1, "uchar");
  no_element.replace(no_element.find("element"), 7, "emement");  // a library broke down on such a property
  for (const std::string& text : {std::string("this is prose"), std::string(), no_element}) {
    EXPECT_NE(fault_of(text).find("a.ply: is no .ply file, or its header is damaged"), std::string::npos) << text;
  }
}

TEST(PlyClaims, ListsLongerThanTheFileAreRefused) {
  const std::string long_list[] = {header("ascii", 1, "uint") + "1 2\n2000000000 0 1 2\n",
                                   header("ascii", 1, "int") + "1 2\n-1 0 1 2\n",
                                   header("binary_little_endian", 1, "uint") + vertex + "\xff\xff\xff\xff" + corners,
                                   header("binary_big_endian", 1, "int") + vertex + "\0\0\0\4"s + corners,
                                   header("binary_little_endian", 1, "int") + vertex + "\xff\xff\xff\xff" + corners};
  for (const std::string& text : long_list) {
    EXPECT_NE(fault_of(text).find("a.ply: ends before"), std::string::npos);
  }
}

TEST(PlyClaims, RowsThatAreNotThereAreRefused) {
  EXPECT_NE(fault_of(header("ascii", 2, "uchar") + "1 2\n3 0 1 2\n"), "");
  EXPECT_NE(fault_of(header("binary_little_endian", 2'000'000'000, "uchar") + vertex + "\3" + corners), "");
}

}  // namespace brainshift::test::ply_claims_test
