// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_gii.hpp"

#include <gifti_io.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/register/shifted.hpp"

namespace brainshift::registration::warp_gii_test {

using namespace builders;
using test::expect_parts;

class WarpGii : public Shifted {
 protected:
  std::string warped(const std::string& text) {
    warp_gii(folder_.write("lh.pial.surf.gii", text), mover_, folder_ / "warped_lh.pial.surf.gii");
    return test::bytes_of(folder_ / "warped_lh.pial.surf.gii");
  }
  std::string refused(const std::string& text) {
    return test::refusal([&] { warped(text); });
  }
};

std::string array(const std::string& intent, const std::string& type, const std::string& size,
                  const std::string& inside, const std::string& data) {
  return "<DataArray Intent=\"NIFTI_INTENT_" + intent + "\" DataType=\"NIFTI_TYPE_" + type +
         "\" ArrayIndexingOrder=\"RowMajorOrder\" " + size +
         " Encoding=\"ASCII\" Endian=\"LittleEndian\" ExternalFileName=\"\" ExternalFileOffset=\"\">" + inside +
         "<Data>" + data + "</Data></DataArray>";
}

std::string space(const std::string& data, const std::string& other, const std::string& matrix) {
  return "<CoordinateSystemTransformMatrix><DataSpace><![CDATA[" + data + "]]></DataSpace><TransformedSpace><![CDATA[" +
         other + "]]></TransformedSpace><MatrixData>" + matrix + "</MatrixData></CoordinateSystemTransformMatrix>";
}

const std::string same = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
const std::string three = "Dimensionality=\"2\" Dim0=\"3\" Dim1=\"3\"";

/// Three points, a triangle, a value and a label a vertex, with metadata.
std::string surface(const std::string& of_points, const std::string& points) {
  return R"(<?xml version="1.0" encoding="UTF-8"?><GIFTI Version="1.0" NumberOfDataArrays="4"><MetaData><MD>
    <Name>Subject</Name><Value><![CDATA[s1]]></Value></MD></MetaData><LabelTable><Label Key="7" Red="1" Green="0"
    Blue="0" Alpha="1"><![CDATA[gyrus]]></Label></LabelTable>)" +
         array("POINTSET", "FLOAT32", three, of_points, points) +
         array("TRIANGLE", "INT32", "Dimensionality=\"2\" Dim0=\"1\" Dim1=\"3\"", "<MetaData/>", "0 1 2") +
         array("SHAPE", "FLOAT32", "Dimensionality=\"1\" Dim0=\"3\"", "<MetaData/>", "2.5 2.25 2.125") +
         array("LABEL", "INT32", "Dimensionality=\"1\" Dim0=\"3\"", "<MetaData/>", "7 7 7") + "</GIFTI>";
}

const std::string no_metadata = "<MetaData/>";
const std::string in_ras = "-3 5 8  -3 5 9  -4 5 9";

/// The numbers of the n-th array that is text.
std::vector<double> numbers_of(const std::string& text, int n) {
  std::size_t begin = 0;
  for (int i = 0; i <= n; ++i) {
    begin = text.find("<Data>", begin) + 6;
  }
  std::istringstream words(text.substr(begin, text.find("</Data>", begin) - begin));
  return {std::istream_iterator<double>(words), {}};
}

/// The numbers of a file of one array of floats.
std::vector<double> shape_of(const std::filesystem::path& file) {
  gifti_image* const shape = gifti_read_image(file.c_str(), 1);
  const auto* const values = static_cast<const float*>(shape->darray[0]->data);
  std::vector<double> numbers(values, values + shape->darray[0]->nvals);
  gifti_free_image(shape);
  return numbers;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1e-4) << i;
  }
}

TEST_F(WarpGii, PointsMoveInTheScannersRasAndAllElseStays) {
  for (const std::string& system : {std::string(), space("NIFTI_XFORM_SCANNER_ANAT", "NIFTI_XFORM_SCANNER_ANAT", same),
                                    space("NIFTI_XFORM_UNKNOWN", "NIFTI_XFORM_TALAIRACH", same)}) {
    const std::string text = warped(surface(no_metadata + system, in_ras));
    expect_near(numbers_of(text, 0), {-4.5, 7, 11, -4.5, 7, 12, -5.5, 7, 12});
    expect_near(numbers_of(text, 1), {0, 1, 2});
    expect_near(numbers_of(text, 2), {2.5, 2.25, 2.125});
    expect_near(numbers_of(text, 3), {7, 7, 7});
    expect_parts(text, {"Subject", "s1", "gyrus", "NIFTI_INTENT_SHAPE", "NIFTI_INTENT_LABEL"});
    EXPECT_EQ(text.find("TALAIRACH") == std::string::npos, system.find("TALAIRACH") == std::string::npos);
  }
  EXPECT_EQ(mover_.moved().outside, 0U);
}

TEST_F(WarpGii, AMatrixToTheScannerTellsWherePointsLie) {
  // Turned by 90° about z and shifted: scanner = (-y + 5, x, z + 100).
  const std::string system =
      space("NIFTI_XFORM_UNKNOWN", "NIFTI_XFORM_SCANNER_ANAT", "0 -1 0 5  1 0 0 0  0 0 1 100  0 0 0 1");
  const std::string text = warped(surface(no_metadata + system, "5 8 -92  5 8 -91  5 9 -91"));
  // The shift of (-1.5, 2, 3), RAS, is (2, 1.5, 3) in the frame of the points.
  expect_near(numbers_of(text, 0), {7, 9.5, -89, 7, 9.5, -88, 7, 10.5, -88});
  EXPECT_EQ(mover_.moved().outside, 0U);
  expect_parts(text, {"NIFTI_XFORM_SCANNER_ANAT", "100"});
}

TEST_F(WarpGii, FreeSurfersSurfaceLiesByTheVolumeOfItsMetadata) {
  const auto metadata = [](const std::string& volume) {
    std::istringstream words(volume);
    std::string text = "<MetaData>", value;
    for (const char axis : std::string("XYZC")) {
      for (const char direction : std::string("RAS")) {
        words >> value;
        text += std::string("<MD><Name>VolGeom") + axis + "_" + direction + "</Name><Value>" + value + "</Value></MD>";
      }
    }
    return text + "</MetaData>";
  };
  // A conformed volume whose middle is (10, -20, 30).
  const std::string conformed =
      warped(surface(metadata("-1 0 0  0 0 -1  0 1 0  10 -20 30"), "-13 25 -22  -13 25 -21  -14 25 -21"));
  expect_near(numbers_of(conformed, 0), {-14.5, 27, -19, -14.5, 27, -18, -15.5, 27, -18});
  // A volume that lies the other way about z: x to the right, y down, z to the back.
  const std::string turned = warped(surface(metadata("1 0 0  0 0 -1  0 -1 0  0 0 0"), "3 -5 8  3 -5 9  4 -5 9"));
  expect_near(numbers_of(turned, 0), {4.5, -7, 11, 4.5, -7, 12, 5.5, -7, 12});
  EXPECT_EQ(mover_.moved().outside, 0U);
}

TEST_F(WarpGii, TheErrorAtItsVerticesIsASurfacesShape) {
  PointMover mover(field_, heights);
  warp_gii(folder_.write("lh.surf.gii", surface(no_metadata, in_ras)), mover, folder_ / "warped_lh.surf.gii");
  const std::string text = test::bytes_of(folder_ / "estimated_error_warped_lh.shape.gii");
  expect_parts(text, {"NIFTI_INTENT_SHAPE", "Dim0=\"3\"", "estimated_error"});
  expect_near(shape_of(folder_ / "estimated_error_warped_lh.shape.gii"), {8, 9, 9});
  expect_near(shape_of(folder_ / "uncertainty_warped_lh.shape.gii"), {16, 18, 18});
}

TEST_F(WarpGii, WhatCannotBeUsedIsRefused) {
  const std::string whole = surface(no_metadata, in_ras);
  expect_parts(refused(whole.substr(0, whole.size() - 60)), {"lh.pial.surf.gii", "damaged or truncated"});
  expect_parts(refused("nothing"), {"no GIFTI file"});
  expect_parts(refused(surface(no_metadata, "-3 5 8 -3 nan 9 -4 5 9")), {"point 2 is not finite"});
  const auto with = [&](const std::string& old, const std::string& other) {
    std::string text = whole;
    return text.replace(text.find(old), old.size(), other);
  };
  expect_parts(refused(with("NIFTI_INTENT_POINTSET", "NIFTI_INTENT_SHAPE")), {"holds no points"});
  expect_parts(refused(surface(space("NIFTI_XFORM_MNI_152", "NIFTI_XFORM_MNI_152", same), in_ras)), {"a template"});
  expect_parts(refused(with("Dim0=\"3\"", "Dim0=\"2000000000\"")), {"larger than the file"});
  expect_parts(refused(with("Encoding=\"ASCII\"", "Encoding=\"ExternalFileBinary\"")), {"another file"});
  for (const char* what : {"Encoding=\"ASCII\"", "Dimensionality=\"2\"", "DataType=\"NIFTI_TYPE_FLOAT32\""}) {
    expect_parts(refused(with(what, "")), {"lh.pial.surf.gii", "an encoding, a type or a size that is none"});
  }
  expect_parts(refused(whole + "<more/>"), {"no GIFTI file"});
  expect_parts(
      refused(
          surface(space("NIFTI_XFORM_UNKNOWN", "NIFTI_XFORM_SCANNER_ANAT", "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1"), in_ras)),
      {"cannot be inverted"});
}

}  // namespace brainshift::registration::warp_gii_test
