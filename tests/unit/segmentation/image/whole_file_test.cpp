// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/whole_file.hpp"

#include <gtest/gtest.h>
#include <itkImageFileWriter.h>

#include <algorithm>
#include <limits>

#include "segmentation/image/gzip_file.hpp"
#include "segmentation/image/image_format.hpp"
#include "segmentation/image/itk_bridge.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::whole_file_test {

namespace fs = std::filesystem;
using std::filesystem::file_size;
using std::filesystem::resize_file;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int size = 5;

/// The sentence about a file; empty when it is whole.
std::string fault(const fs::path& file, std::uint64_t components = 1) {
  return refusal([&] { check_whole(file, image_format(file), components); });
}

/// Voxels 0, 1, 2, ... as they are in memory, not compressed.
template <class T>
Image<T> counted() {
  Image<T> image{grid_around({1, 2, 3}, size, {1, 2, 3}, Eigen::Matrix3d::Identity()), {}};
  for (int voxel = 0; voxel < size * size * size; ++voxel) {
    image.voxels.push_back(static_cast<T>(voxel));
  }
  return image;
}

template <class T>
void write_plain(const fs::path& file, const Image<T>& image) {
  auto writer = itk::ImageFileWriter<ItkImage<T>>::New();
  writer->SetInput(seen_by_itk(image));
  writer->SetImageIO(make_image_io(image_format(file)));
  writer->SetFileName(file.string());
  writer->Update();
}

/// A NIfTI file with every number in the other byte order.
std::string turned(std::string bytes) {
  const auto turn = [&](std::size_t begin, std::size_t end, std::size_t length) {
    for (; begin < end; begin += length) {
      std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                   bytes.begin() + static_cast<std::ptrdiff_t>(begin + length));
    }
  };
  turn(0, 4, 4);      // size of the header
  turn(40, 56, 2);    // dimensions
  turn(56, 68, 4);    // intent
  turn(68, 76, 2);    // data type
  turn(76, 120, 4);   // spacing, offset and slope
  turn(120, 122, 2);  // last slice
  turn(124, 148, 4);  // display range and times
  turn(252, 256, 2);  // codes of the frames
  turn(256, 328, 4);  // the frames
  turn(352, bytes.size(), 4);
  return bytes;
}

TEST(WholeFile, OfEveryFormatIsAccepted) {
  const ScratchFolder folder;
  const VectorImage vectors{counted<float>().geometry, std::vector<std::array<float, 3>>(size * size * size)};
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.mha"}) {
    write_image(folder / name, counted<float>());
    EXPECT_EQ(fault(folder / name), "");
    write_image(folder / name, counted<std::uint16_t>());
    EXPECT_EQ(fault(folder / name), "");
    write_image(folder / name, vectors);
    EXPECT_EQ(fault(folder / name, 3), "");
  }
}

TEST(WholeFile, ThatLacksOneByteIsRefusedWithWhatItPromisesAndHolds) {
  const ScratchFolder folder;
  for (const char* name : {"a.nii", "a.mha"}) {
    write_plain(folder / name, counted<std::uint16_t>());
    EXPECT_EQ(fault(folder / name), "");
    resize_file(folder / name, file_size(folder / name) - 1);
    expect_parts(fault(folder / name), {(folder / name).string(), "truncated", "promises 250 bytes", "holds 249"});
  }
  write_image(folder / "packed.mha", counted<float>());
  resize_file(folder / "packed.mha", file_size(folder / "packed.mha") - 1);
  expect_parts(fault(folder / "packed.mha"), {"packed.mha", "truncated"});
}

TEST(WholeFile, ThatWasShortBeforeItWasCompressedIsRefused) {
  const ScratchFolder folder;
  write_plain(folder / "a.nii", counted<double>());
  resize_file(folder / "a.nii", file_size(folder / "a.nii") - 8);
  write_gzip(folder / "a.nii.gz", folder / "a.nii");
  expect_parts(fault(folder / "a.nii.gz"), {"a.nii.gz", "promises 1000 bytes", "holds 992"});
}

TEST(WholeFile, ThatIsShortIsRefusedWhateverItSaysOfTheBitsOfAVoxel) {
  const ScratchFolder folder;
  write_plain(folder / "a.nii", counted<float>());
  std::string bytes = bytes_of(folder / "a.nii");
  for (const int bits : {0, 8, 64}) {
    bytes[72] = static_cast<char>(bits);
    EXPECT_EQ(fault(folder.write("whole.nii", bytes)), "") << bits;
    expect_parts(fault(folder.write("short.nii", bytes.substr(0, bytes.size() - 4))), {"promises 500", "holds 496"});
    EXPECT_THROW(read_image(folder / "short.nii"), std::invalid_argument);
    EXPECT_EQ(read_image(folder / "whole.nii").voxels, counted<float>().voxels);
  }
}

TEST(WholeFile, OfLessThanAHeaderIsRefused) {
  const ScratchFolder folder;
  write_plain(folder / "a.nii", counted<float>());
  resize_file(folder / "a.nii", 351);
  expect_parts(fault(folder / "a.nii"), {"a.nii", "header"});
}

TEST(WholeFile, NamesTheFirstValueThatIsNotFiniteAndCountsThem) {
  const ScratchFolder folder;
  ScalarImage floats = counted<float>();
  Image<double> doubles = counted<double>();
  floats.at(2, 0, 3) = floats.at(4, 4, 4) = static_cast<float>(nan);
  doubles.at(2, 0, 3) = std::numeric_limits<double>::infinity();
  write_plain(folder / "f.nii", floats);
  write_plain(folder / "d.nii", doubles);
  expect_parts(fault(folder / "f.nii"), {"f.nii", "2 value(s) are not finite", "first at voxel (2, 0, 3)"});
  expect_parts(fault(folder / "d.nii"), {"d.nii", "1 value(s) are not finite", "first at voxel (2, 0, 3)"});
}

TEST(WholeFile, NamesTheVoxelOfAVectorWhicheverComponentIsNotFinite) {
  const ScratchFolder folder;
  VectorImage vectors{counted<float>().geometry, std::vector<std::array<float, 3>>(size * size * size)};
  vectors.at(1, 2, 3)[2] = static_cast<float>(nan);
  write_image(folder / "v.nii", vectors);
  expect_parts(fault(folder / "v.nii", 3), {"1 value(s)", "voxel (1, 2, 3)"});
}

TEST(WholeFile, InTheOtherByteOrderIsTheSame) {
  const ScratchFolder folder;
  ScalarImage image = counted<float>();
  write_plain(folder / "a.nii", image);
  const auto other = folder.write("other.nii", turned(bytes_of(folder / "a.nii")));
  EXPECT_EQ(fault(other), "");
  EXPECT_EQ(read_image(other).voxels, image.voxels);
  resize_file(other, file_size(other) - 4);
  expect_parts(fault(other), {"promises 500 bytes", "holds 496"});
  image.at(0, 1, 0) = static_cast<float>(nan);
  write_plain(folder / "a.nii", image);
  expect_parts(fault(folder.write("other.nii", turned(bytes_of(folder / "a.nii")))), {"1 value(s)", "(0, 1, 0)"});
}

TEST(VoxelName, CountsXFastest) {
  EXPECT_EQ(voxel_name({3, 4, 5}, 0), "voxel (0, 0, 0)");
  EXPECT_EQ(voxel_name({3, 4, 5}, 2), "voxel (2, 0, 0)");
  EXPECT_EQ(voxel_name({3, 4, 5}, 3), "voxel (0, 1, 0)");
  EXPECT_EQ(voxel_name({3, 4, 5}, 59), "voxel (2, 3, 4)");
}

TEST(DeclaredVoxels, AreThoseOfTheHeaderAlone) {
  const ScratchFolder scratch;
  for (const char* name : {"image.nii", "image.nii.gz", "image.mha", "image.nrrd"}) {
    const fs::path file = scratch / name;
    write_image(file, counted<float>());
    EXPECT_EQ(declared_voxels(file), size * size * size) << name;
  }
  resize_file(scratch / "image.nii", file_size(scratch / "image.nii") - 4);
  EXPECT_EQ(declared_voxels(scratch / "image.nii"), size * size * size) << "at the voxels nothing looks";
  EXPECT_FALSE(declared_voxels(scratch.path())) << "slices of DICOM";
}

}  // namespace brainshift::test::whole_file_test
