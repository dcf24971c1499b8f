// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/vtk_claims.hpp"

#include <gtest/gtest.h>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::vtk_claims_test {

using namespace std::string_literals;

std::string said_of(const std::string& text) {
  const ScratchFolder folder;
  return refusal([&] { check_vtk_claims(folder.write("in.vtp", text)); });
}

/// A file of one compressed array, appended in `encoding`.
std::string appended(const std::string& attributes, const std::string& encoding, const std::string& data) {
  return "<VTKFile type=\"PolyData\" compressor=\"vtkZLibDataCompressor\" " + attributes +
         "><Piece NumberOfPoints=\"8\"><DataArray format=\"appended\" offset=\"2\"/></Piece><AppendedData encoding=\"" +
         encoding + "\">\n _  " + data + "</AppendedData></VTKFile>";
}

TEST(VtkClaims, BlocksThatAFileCanHoldPass) {
  EXPECT_EQ(said_of(appended("header_type=\"UInt32\"", "base64", "AQAAAACAAADAAAAA")), "");
  EXPECT_EQ(said_of(appended("", "raw", "\1\0\0\0\0\x80\0\0\xc0\0\0\0"s)), "");
  EXPECT_EQ(said_of(appended("header_type=\"UInt64\" byte_order=\"BigEndian\"", "base64",
                             "AAAAAAAAAAEAAAAAAACAAAAAAAAAAADA")),
            "");
  EXPECT_EQ(said_of("this is prose"), "");
  EXPECT_EQ(said_of(""), "");
}

TEST(VtkClaims, MoreBlocksThanTheFileHasBytesAreRefused) {
  for (const std::string& text :
       {appended("header_type=\"UInt32\"", "base64", "/////wCAAADAAAAA"),
        appended("header_type=\"UInt32\"", "base64", "AQAAAAAAAIDAAAAA"),
        appended("", "raw", "\0\0\0\x7f\0\x80\0\0\xc0\0\0\0"s),
        "<VTKFile compressor=\"x\"><DataArray format=\"binary\">\n/////wCAAADAAAAA</DataArray></VTKFile>"s}) {
    EXPECT_NE(said_of(text).find("in.vtp: an array of it says to hold more than"), std::string::npos) << text;
  }
}

TEST(VtkClaims, MorePointsThanTheFileCanHoldAreRefused) {
  EXPECT_EQ(said_of("<Piece NumberOfPoints=\"3\">"), "");
  EXPECT_NE(said_of("<Piece NumberOfPoints=\"2000000000\">").find("says to hold more Points"), std::string::npos);
  EXPECT_NE(said_of("<Piece NumberOfPoints=\"9000\"><DataArray NumberOfComponents=\"9000\">").find("more numbers"),
            std::string::npos);
}

}  // namespace brainshift::test::vtk_claims_test
