// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/image_header.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <limits>

#include "segmentation/image/frame_note.hpp"
#include "segmentation/image/gzip_file.hpp"
#include "segmentation/image/image.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::image_header_test {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

template <class T>
void put(std::string& bytes, std::size_t place, T value) {
  std::memcpy(bytes.data() + place, &value, sizeof(T));
}

/// 3 x 4 x 5 voxels of 2 mm, as labels.
std::string nifti_bytes() {
  std::string bytes(352 + 60, '\0');
  put<std::int32_t>(bytes, 0, 348);
  const std::int16_t sizes[] = {3, 3, 4, 5};
  std::memcpy(bytes.data() + 40, sizes, sizeof(sizes));
  put<std::int16_t>(bytes, 70, 2);  // uint8
  put<std::int16_t>(bytes, 72, 8);
  const float steps[] = {1, 2, 2, 2};
  std::memcpy(bytes.data() + 76, steps, sizeof(steps));
  put<float>(bytes, 108, 352);
  put<std::int16_t>(bytes, 252, 1);
  put<std::int16_t>(bytes, 254, 1);
  for (const std::size_t axis : {0U, 1U, 2U}) {
    put<float>(bytes, 280 + 20 * axis, 2);
  }
  std::memcpy(bytes.data() + 344, "n+1", 4);
  return bytes;
}

std::string meta_text(const std::string& changes = "", const std::string& data = "LOCAL") {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\n" + changes +
         "DimSize = 3 4 5\nElementType = MET_UCHAR\nElementDataFile = " + data + "\n";
}

std::string nrrd_text(const std::string& changes, const std::string& encoding = "raw") {
  return "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: 3 4 5\n" + changes +
         "encoding: " + encoding + "\n\n";
}

const std::string voxels(60, '\1');

/// A file with that in its header.
std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to) + voxels;
}

std::string fault_of(const std::filesystem::path& file) {
  return refusal([&] { read_label_map(file); });
}

::testing::AssertionResult refused(const std::filesystem::path& file, const std::vector<std::string>& words) {
  return throws_saying<std::invalid_argument>([&] { read_label_map(file); }, words);
}

TEST(ImageHeader, SoundOnesOfEveryFormatAreRead) {
  const ScratchFolder folder;
  EXPECT_EQ(fault_of(folder.write("a.nii", nifti_bytes())), "");
  EXPECT_EQ(fault_of(folder.write("a.mha", meta_text() + voxels)), "");
  EXPECT_EQ(fault_of(folder.write("a.nrrd", nrrd_text("space directions: (1,0,0) (0,0,2) (0,1,0)\n") + voxels)), "");
  EXPECT_EQ(fault_of(folder.write("b.nrrd", nrrd_text("") + voxels)), "");
  const ImageHeader header = read_nrrd_header(folder / "a.nrrd");
  EXPECT_EQ(header.spacing, Eigen::Vector3d(1, 2, 1));
  EXPECT_EQ(header.bytes(), 60U);
}

// Library and processor would end the program on them.
TEST(ImageHeader, ANiftiFormThatIsNotFiniteIsRefused) {
  const ScratchFolder folder;
  for (const float bad : {not_a_number, infinite, 1e30F}) {
    for (const std::size_t place : {256U, 268U, 280U, 292U, 324U}) {
      std::string bytes = nifti_bytes();
      put(bytes, place, bad);
      EXPECT_TRUE(refused(folder.write("a.nii", bytes), {"a.nii", "form", "repair"})) << bad << place;
    }
    std::string bytes = nifti_bytes();
    put(bytes, 80, bad);
    EXPECT_TRUE(refused(folder.write("a.nii", bytes), {"a.nii", "repair"}));
  }
}

TEST(ImageHeader, ANiftiFormThatIsShearedOrOfAnotherVoxelIsRefused) {
  const ScratchFolder folder;
  std::string sheared = nifti_bytes(), doubled = nifti_bytes(), tiny = nifti_bytes();
  put<std::int16_t>(sheared, 252, 0);
  put<float>(sheared, 284, 1);
  put<float>(doubled, 280, 4);
  put<float>(tiny, 284, 1e-40F);
  EXPECT_TRUE(refused(folder.write("a.nii", sheared), {"sheared"}));
  EXPECT_TRUE(refused(folder.write("a.nii", doubled), {"pixdim"}));
  EXPECT_TRUE(refused(folder.write("a.nii", tiny), {"sform"}));
  std::string slightly = nifti_bytes();
  put<std::int16_t>(slightly, 252, 0);
  put<float>(slightly, 280, 2.002F);
  EXPECT_TRUE(refused(folder.write("a.nii", slightly), {"size of a voxel"}));
}

TEST(ImageHeader, ANiftiWithVoxelsOfANegativeSizeIsRefused) {
  const ScratchFolder folder;
  for (const std::size_t place : {80U, 84U, 88U}) {
    std::string bytes = nifti_bytes();
    put<float>(bytes, place, -2);
    EXPECT_TRUE(refused(folder.write("a.nii", bytes), {"a.nii", "negative size", "pixdim"})) << place;
  }
}

TEST(ImageHeader, ANiftisUnitOfTimeIsTold) {
  const ScratchFolder folder;
  for (const auto& [unit, seconds] : {std::pair('\x0a', 1.0), {'\x12', 1e-3}, {'\x1a', 1e-6}, {'\x02', 1.0}}) {
    std::string bytes = nifti_bytes();
    bytes[123] = unit;
    EXPECT_EQ(read_nifti_header(folder.write("a.nii", bytes)).seconds, seconds);
  }
}

/// ITK reads vectors as they are stored, and crashes on scaled ones of whole numbers.
TEST(ImageHeader, ANiftiFieldWithScaledVectorsIsRefused) {
  const ScratchFolder folder;
  std::string field = nifti_bytes();
  const std::int16_t sizes[] = {5, 3, 4, 5, 1, 3};
  std::memcpy(field.data() + 40, sizes, sizeof(sizes));
  const auto scaled = [&](float slope, float intercept) {
    std::string bytes = field;
    put<float>(bytes, 112, slope);
    put<float>(bytes, 116, intercept);
    return folder.write("a.nii", bytes);
  };
  for (const auto& [slope, intercept] : {std::pair(2.0F, 0.0F), {1.0F, -1.0F}}) {
    EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_nifti_header(scaled(slope, intercept)); },
                                                     {"a.nii", "its vectors are scaled"}));
  }
  for (const float slope : {0.0F, 1.0F, not_a_number}) {
    EXPECT_EQ(read_nifti_header(scaled(slope, 0)).components, 3U) << slope;
  }
}

TEST(ImageHeader, ANiftiThatAddsToWhatItDoesNotScaleIsRefused) {
  const ScratchFolder folder;
  std::string bytes = nifti_bytes();
  put<float>(bytes, 116, 10);
  EXPECT_TRUE(refused(folder.write("a.nii", bytes), {"a.nii", "scl_inter"}));
}

TEST(ImageHeader, AMetaImageInOtherUnitsOrScaledIsRefused) {
  const ScratchFolder folder;
  for (const auto& [line, part] : {std::pair("DistanceUnits = cm", "unit of length is cm"),
                                   {"ElementToIntensityFunctionSlope = 2", "scaled"},
                                   {"ElementToIntensityFunctionOffset = 5", "scaled"}}) {
    EXPECT_TRUE(refused(folder.write("a.mha", meta_text(line + std::string("\n")) + voxels), {"a.mha", part})) << line;
  }
  const std::string usual = "DistanceUnits = mm\nElementToIntensityFunctionSlope = 1\n";
  EXPECT_NO_THROW(read_meta_header(folder.write("a.mha", meta_text(usual) + voxels)));
}

TEST(ImageHeader, FormsThatDisagreeAreTold) {
  const ScratchFolder folder;
  std::string shifted = nifti_bytes();
  EXPECT_EQ(frame_note(folder.write("a.nii", shifted)), "");
  put<float>(shifted, 292, 7);
  const std::string note = frame_note(folder.write("a.nii", shifted));
  EXPECT_NE(note.find("7 mm apart; the sform was taken"), std::string::npos) << note;
  EXPECT_EQ(read_nifti_header(folder / "a.nii").origin.x(), 7);
  for (const auto code : {std::int16_t{2}, std::int16_t{4}}) {  // not the scanner's
    put<std::int16_t>(shifted, 254, code);
    const auto file = folder.write("a.nii", shifted);
    EXPECT_NE(frame_note(file).find("the qform was taken"), std::string::npos);
    EXPECT_EQ(read_nifti_header(file).origin.x(), 0);
    EXPECT_EQ(read_image(file).geometry.origin.x(), 0) << "LPS of 0 is 0, too";
  }
  std::string turned = nifti_bytes();
  put<float>(turned, 280, 0);  // x and y change places, which moves two corners of a cube alone
  put<float>(turned, 284, 2);
  put<float>(turned, 296, 2);
  put<float>(turned, 300, 0);
  EXPECT_NE(frame_note(folder.write("a.nii", turned)), "");
  put<std::int16_t>(shifted, 252, 0);
  EXPECT_EQ(frame_note(folder.write("a.nii", shifted)), "") << "there is one form alone";
  EXPECT_EQ(frame_note("image.mha"), "");
  EXPECT_EQ(frame_note(""), "");
}

/// Which a quaternion, a rotation, cannot say.
TEST(ImageHeader, ANiftisQformIsMirroredAlongItsThirdAxisWherePixdimSaysSo) {
  const ScratchFolder folder;
  std::string bytes = nifti_bytes();
  put<std::int16_t>(bytes, 254, 0);
  for (const float qfac : {1.0F, 0.0F, -1.0F}) {
    put<float>(bytes, 76, qfac);
    const auto file = folder.write("a.nii", bytes);
    const double side = qfac < 0 ? -1 : 1;
    EXPECT_EQ(read_nifti_header(file).direction, Eigen::Vector3d(1, 1, side).asDiagonal().toDenseMatrix()) << qfac;
    EXPECT_EQ(read_image(file).geometry.direction(2, 2), side) << "as ITK has it";
  }
}

TEST(ImageHeader, ANiftiInMetresIsRefused) {
  const ScratchFolder folder;
  std::string bytes = nifti_bytes();
  for (const auto& [unit, taken] : {std::pair<char, bool>(0, true), {2, true}, {10, true}, {1, false}, {3, false}}) {
    bytes[123] = unit;  // with seconds, 8, in 10
    EXPECT_EQ(fault_of(folder.write("a.nii", bytes)).find("not the millimetre") == std::string::npos, taken);
  }
}

TEST(ImageHeader, ANiftiFieldThatCannotBeIsRefused) {
  const ScratchFolder folder;
  const auto with = [&](std::size_t place, std::int16_t value) {
    std::string bytes = nifti_bytes();
    put(bytes, place, value);
    return folder.write("a.nii", bytes);
  };
  EXPECT_TRUE(refused(with(40, 0), {"0 dimensions"}));
  EXPECT_TRUE(refused(with(42, -3), {"-3 voxels"}));
  EXPECT_TRUE(refused(with(46, 32767), {"truncated", "393204 bytes"}));
  EXPECT_TRUE(refused(with(70, 32), {"type 32"}));
  EXPECT_TRUE(refused(with(344, 0), {"no NIfTI-1"}));
  EXPECT_TRUE(refused(with(0, 540), {"NIfTI-2"}));
  std::string bytes = nifti_bytes();
  put(bytes, 108, not_a_number);
  EXPECT_TRUE(refused(folder.write("a.nii", bytes), {"offset"}));
}

TEST(ImageHeader, AMetaImageDirectionThatIsNoneIsRefused) {
  const ScratchFolder folder;
  for (const std::string matrix : {"1 0 0 0 1 0 0 0 1e308", "1 0 0 0 inf 0 0 0 1", "1 0 0 0 -32769 0 0 0 1",
                                   "2 0 0 0 2 0 0 0 2", "1 0.5 0 0 1 0 0 0 1", "1 0 0 1 0 0 0 0 1", "1 0 0", "a"}) {
    const auto file = folder.write("a.mha", meta_text("TransformMatrix = " + matrix + "\n") + voxels);
    EXPECT_TRUE(refused(file, {"a.mha", "header"})) << matrix;
  }
  for (const std::string line : {"Offset = 0 nan 0", "Offset = 1e300 0 0", "ElementSpacing = 1 0 1",
                                 "ElementSpacing = -1 1 1", "CenterOfRotation = 0 0", "ElementSpacing = inf 1 1"}) {
    EXPECT_TRUE(refused(folder.write("a.mha", meta_text(line + "\n") + voxels), {"a.mha", "header"})) << line;
  }
}

// What is read from another file may be any file, and where it is too short memory that nobody set.
TEST(ImageHeader, AMetaImageWhoseVoxelsAreElsewhereIsRefused) {
  const ScratchFolder folder;
  for (const std::string data : {"LIST", "other.raw", "/etc/passwd", "LOCALE", ""}) {
    EXPECT_TRUE(refused(folder.write("a.mha", meta_text("", data) + voxels), {"a.mha", "LOCAL"})) << data;
  }
  EXPECT_TRUE(refused(folder.write("a.mha", meta_text("DimSize = 3 4 5\n") + voxels), {"DimSize twice"}));
  EXPECT_TRUE(refused(folder.write("a.mhd", meta_text() + voxels), {"a.mhd: images end in"}));
}

TEST(ImageHeader, ANrrdHeaderWithALongLineIsRefusedButNotALongValueOfTheUser) {
  const ScratchFolder folder;
  const std::string length(1000, 'x');
  for (const std::string& line : {length + ": 1\n", length + ":=1\n", "content: " + length + "\n"}) {
    EXPECT_TRUE(refused(folder.write("a.nrrd", nrrd_text(line) + voxels), {"a.nrrd", "500 characters"}));
  }
  EXPECT_EQ(fault_of(folder.write("a.nrrd", nrrd_text("conversion:=" + length + "\n# " + length + "\n") + voxels)), "");
}

TEST(ImageHeader, ANrrdGeometryOrStorageThatCannotBeIsRefused) {
  const ScratchFolder folder;
  for (const std::string line :
       {"space directions: (1,nan,0) (0,1,0) (0,0,1)", "space directions: (1,0,0) (0,1,0) (0,0,inf)",
        "space directions: (1,0,0) (1,1,0) (0,0,1)", "space directions: (1,0,0) (0,1,0)", "space origin: (nan,0,0)",
        "space directions: 1 2 3", "data file: other.raw", "byte skip: 5", "sizes: 3 4 5", "block size: 3"}) {
    EXPECT_TRUE(refused(folder.write("a.nrrd", nrrd_text(line + "\n") + voxels), {"a.nrrd"})) << line;
  }
  EXPECT_TRUE(refused(folder.write("a.nrrd", nrrd_text("", "bzip2") + voxels), {"encoding"}));
}

TEST(ImageHeader, ThatPromisesMoreThanTheFileHoldsIsRefusedBeforeAnythingIsAllocated) {
  const ScratchFolder folder;
  EXPECT_TRUE(refused(folder.write("a.mha", changed(meta_text("CompressedData = True\n"), "3 4 5", "800 800 800")),
                      {"truncated", "512000000"}));
  EXPECT_TRUE(refused(folder.write("a.nrrd", changed(nrrd_text(""), "3 4 5", "800 800 800")), {"truncated"}));
  EXPECT_TRUE(refused(folder.write("a.nrrd", changed(nrrd_text("", "gzip"), "3 4 5", "800 800 800")), {"truncated"}));
  EXPECT_TRUE(refused(folder.write("a.nrrd", changed(nrrd_text(""), "3 4 5", "90000 90000 90000")), {"GB of memory"}));
  EXPECT_TRUE(refused(folder.write("a.nrrd", changed(nrrd_text(""), "3 4 5", "1000 1000 1000")),
                      {"1000 x 1000 x 1000 voxels", "some 30 GB of memory", "resample"}));
  EXPECT_TRUE(refused(folder.write("a.nrrd", changed(nrrd_text(""), "3 4 5", "3 4 99999999999999999999")), {"sizes"}));
}

TEST(ImageHeader, CompressedVoxelsMustGiveWhatItPromises) {
  const ScratchFolder folder;
  const auto deflated = [&](std::size_t size) {
    write_gzip(folder / "z", folder.write("plain", std::string(size, '\1')));
    return bytes_of(folder / "z");
  };
  const std::string mha = meta_text("CompressedData = True\n"), nrrd = nrrd_text("", "gzip");
  EXPECT_EQ(fault_of(folder.write("a.nrrd", nrrd + deflated(60))), "");
  for (const std::size_t size : {59U, 61U, 5000000U}) {
    EXPECT_TRUE(refused(folder.write("a.nrrd", nrrd + deflated(size)), {"cut short or damaged"})) << size;
    EXPECT_TRUE(refused(folder.write("a.mha", mha + deflated(size)), {"cut short or damaged"})) << size;
  }
  EXPECT_TRUE(refused(folder.write("a.mha", mha + deflated(60).substr(0, 15)), {"cut short or damaged"}));
  write_gzip(folder / "bomb.nii.gz", folder.write("bomb", nifti_bytes() + std::string(5000000, '\0')));
  EXPECT_TRUE(refused(folder / "bomb.nii.gz", {"bomb.nii.gz", "goes on"}));
  write_gzip(folder / "padded.nii.gz", folder.write("padded", nifti_bytes() + std::string(1000, '\0')));
  EXPECT_EQ(fault_of(folder / "padded.nii.gz"), "");
}

TEST(ImageHeader, WhatIsNoRegularFileIsNotOpened) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.nii.gz").c_str(), 0600), 0);
  EXPECT_TRUE(refused(folder / "pipe.nii.gz", {"pipe.nii.gz", "a pipe"}));
  std::filesystem::create_symlink("/dev/zero", folder / "zero.nrrd");
  EXPECT_TRUE(refused(folder / "zero.nrrd", {"zero.nrrd", "a device"}));
  std::filesystem::create_symlink("loop.mha", folder / "loop.mha");
  EXPECT_TRUE(refused(folder / "loop.mha", {"loop.mha: cannot be reached"}));
  EXPECT_TRUE(refused(folder / std::string(300, 'a'), {"cannot be reached"}));
}

TEST(ImageHeader, AFileWithoutPermissionIsSaidToBeThat) {
  const ScratchFolder folder;
  const auto file = folder.write("a.mha", meta_text() + voxels);
  std::filesystem::permissions(file, std::filesystem::perms::none);
  if (::access(file.c_str(), R_OK) == 0) {
    GTEST_SKIP() << "this user may read every file";
  }
  EXPECT_TRUE(refused(file, {"a.mha", "permission"}));
}

TEST(ImageHeader, ANrrdIsReadInLpsAndRasAlone) {
  const ScratchFolder folder;
  const auto in_space = [&](const std::string& space) {
    return folder.write("a.nrrd", changed(nrrd_text(""), "left-posterior-superior", space));
  };
  for (const std::string space : {"RAS", "right-anterior-superior", "LPS"}) {
    EXPECT_EQ(fault_of(in_space(space)), "");
    EXPECT_EQ(frame_note(in_space(space)), "");
  }
  for (const std::string space : {"left-anterior-superior", "LAS", "scanner-xyz", "3D-left-handed"}) {
    EXPECT_TRUE(refused(in_space(space), {"a.nrrd", "left-posterior-superior"})) << space;
  }
  const std::string none = changed(nrrd_text(""), "space: left-posterior-superior\n", "");
  EXPECT_EQ(fault_of(folder.write("a.nrrd", none)), "");
  EXPECT_NE(frame_note(folder / "a.nrrd").find("no anatomical space is named"), std::string::npos);
  const auto in_units = [&](const std::string& unit) {
    const std::string units = "space units: \"" + unit + "\" \"" + unit + "\" \"" + unit + "\"\n";
    return fault_of(folder.write("a.nrrd", nrrd_text(units) + voxels));
  };
  EXPECT_EQ(in_units("mm"), "");
  EXPECT_EQ(in_units("millimeter"), "");
  EXPECT_NE(in_units("m").find("in mm"), std::string::npos);
}

TEST(ImageHeader, VectorsOfANrrdAreInLps) {
  const ScratchFolder folder;
  const auto field = [&](const std::string& space, const std::string& frame) {
    const std::string text = "NRRD0004\ntype: float\ndimension: 4\nspace: " + space +
                             "\nsizes: 3 2 2 2\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n" + frame +
                             "kinds: vector domain domain domain\nendian: little\nencoding: raw\n\n";
    return folder.write("field.nrrd", text + std::string(4 * 24, '\0'));
  };
  const auto fault = [&](const std::filesystem::path& file) { return refusal([&] { read_vector_image(file); }); };
  EXPECT_EQ(fault(field("left-posterior-superior", "")), "");
  EXPECT_EQ(fault(field("LPS", "measurement frame: (1,0,0) (0,1,0) (0,0,1)\n")), "");
  EXPECT_NE(fault(field("LPS", "measurement frame: (-1,0,0) (0,-1,0) (0,0,1)\n")).find("in LPS"), std::string::npos);
  EXPECT_NE(fault(field("RAS", "")).find("in LPS"), std::string::npos);
}

TEST(ImageHeader, ANiftiWithoutAFormIsToldOf) {
  const ScratchFolder folder;
  std::string bytes = nifti_bytes();
  put<std::int16_t>(bytes, 252, 0);
  put<std::int16_t>(bytes, 254, 0);
  EXPECT_EQ(fault_of(folder.write("a.nii", bytes)), "");
  EXPECT_NE(frame_note(folder / "a.nii").find("which side is left"), std::string::npos);
}

}  // namespace brainshift::test::image_header_test
