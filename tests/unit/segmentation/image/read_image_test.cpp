// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/itk_bridge.hpp"  // before ITK's headers

#include <gtest/gtest.h>
#include <itkImageFileWriter.h>
#include <itkNiftiImageIO.h>

#include <limits>

#include "tests/unit/file_size_limit.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::read_image_test {

using std::filesystem::file_size;
using std::filesystem::resize_file;

class EveryFormat : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Image, EveryFormat, ::testing::Values("a.nii", "a.nii.gz", "a.nrrd", "a.mha"),
                         [](const auto& named) {
                           std::string name = named.param.substr(2);
                           std::erase(name, '.');
                           return name;
                         });

TEST_P(EveryFormat, GivesBackVoxelsAndPlace) {
  const ScratchFolder folder;
  const ScalarImage image = wavy_image();
  write_image(folder / GetParam(), image);
  const ScalarImage back = read_image(folder / GetParam());
  EXPECT_EQ(back.voxels, image.voxels);
  EXPECT_TRUE(same_geometry(back.geometry, image.geometry));
}

/// NIfTI's own library takes the voxels of a.nii for those of a.nii.gz.
TEST(ReadImage, TakesTheFileThatIsNamedAndNotOneBesideIt) {
  const ScratchFolder folder;
  const ScalarImage image = wavy_image();
  ScalarImage other = image;
  for (float& value : other.voxels) {
    value += 1;
  }
  write_image(folder / "a.nii.gz", image);
  write_image(folder / "a.nii", other);
  EXPECT_EQ(read_image(folder / "a.nii.gz").voxels, image.voxels);
  EXPECT_EQ(read_image(folder / "a.nii").voxels, other.voxels);
}

TEST_P(EveryFormat, GivesBackLabels) {
  const ScratchFolder folder;
  const LabelMap labels = ball(wavy_image().geometry, {40.0, -70.0, 15.0}, 9.0);
  write_image(folder / GetParam(), labels);
  EXPECT_EQ(read_label_map(folder / GetParam()).voxels, labels.voxels);
}

TEST_P(EveryFormat, GivesBackTheLargestLabels) {
  const ScratchFolder folder;
  LabelMap labels = ball(wavy_image().geometry, {40.0, -70.0, 15.0}, 9.0);
  labels.at(1, 2, 3) = 32768;
  labels.at(3, 2, 1) = 65535;
  write_image(folder / GetParam(), labels);
  EXPECT_EQ(read_label_map(folder / GetParam()).voxels, labels.voxels);
}

TEST_P(EveryFormat, GivesBackVectorsInLps) {
  const ScratchFolder folder;
  const auto field = image_by<std::array<float, 3>>(wavy_image().geometry, [](const Eigen::Vector3d& x) {
    return std::array<float, 3>{static_cast<float>(x.x()), static_cast<float>(x.y()), 1.5F};
  });
  write_image(folder / GetParam(), field);
  EXPECT_EQ(read_vector_image(folder / GetParam()).voxels, field.voxels);
}

TEST_P(EveryFormat, IsRefusedWhenHalfOfItIsMissing) {
  const ScratchFolder folder;
  const auto file = folder / GetParam();
  write_image(file, wavy_image());
  resize_file(file, file_size(file) / 2);
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_image(file); }, {file.string(), "truncated"}) ||
              throws_saying<std::invalid_argument>([&] { read_image(file); }, {file.string(), "cut short"}));
}

TEST_P(EveryFormat, IsRefusedWhenEmptyOrText) {
  const ScratchFolder folder;
  const auto file = folder / GetParam();
  std::ofstream(file).flush();
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_image(file); }, {file.string(), "empty"}));
  std::ofstream(file) << std::string(5000, 'x');
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_image(file); }, {file.string()}));
}

TEST_P(EveryFormat, LeavesNoFileWhenTheDiskIsFull) {
  const ScratchFolder folder;
  const auto file = folder / GetParam();
  {
    const FileSizeLimit full(4096);
    EXPECT_TRUE(
        throws_saying<std::runtime_error>([&] { write_image(file, wavy_image()); }, {file.string(), "written whole"}));
  }
  EXPECT_TRUE(std::filesystem::is_empty(file.parent_path()));
}

TEST(ImageIo, ASingleVolumeOfAFourDimensionalImageIsTakenAndTwoAreRefused) {
  const ScratchFolder folder;
  for (const unsigned volumes : {1U, 2U}) {
    auto image = itk::Image<float, 4>::New();
    image->SetRegions(itk::Size<4>{5, 6, 7, volumes});
    image->Allocate(true);
    auto writer = itk::ImageFileWriter<itk::Image<float, 4>>::New();
    writer->SetImageIO(itk::NiftiImageIO::New());
    writer->SetInput(image);
    writer->SetFileName((folder / "four.nii").string());
    writer->Update();
    if (volumes == 1) {
      EXPECT_EQ(read_image(folder / "four.nii").voxels.size(), 210U);
    } else {
      EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_image(folder / "four.nii"); }, {"5 x 6 x 7 x 2"}));
    }
  }
}

// NIfTI's library turns such values into zeros on reading.
TEST_P(EveryFormat, AVoxelThatIsNotANumberIsNamed) {
  const ScratchFolder folder;
  ScalarImage image = wavy_image();
  image.at(3, 4, 5) = std::numeric_limits<float>::quiet_NaN();
  image.at(3, 4, 6) = std::numeric_limits<float>::infinity();
  write_image(folder / GetParam(), image);
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_image(folder / GetParam()); },
                                                   {GetParam(), "2 value(s)", "voxel (3, 4, 5)"}));
}

TEST(ImageIo, ALabelThatIsNoWholeNumberIsNamed) {
  const ScratchFolder folder;
  ScalarImage image = wavy_image();
  std::fill(image.voxels.begin(), image.voxels.end(), 1.0F);
  for (const float bad : {1.5F, 65536.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
    image.at(1, 0, 2) = bad;
    write_image(folder / "l.nii", image);
    EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_label_map(folder / "l.nii"); }, {"voxel (1, 0, 2)"}));
  }
  image.at(1, 0, 2) = 0.999999F;
  write_image(folder / "near.nii", image);
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_label_map(folder / "near.nii"); }, {"holds 0.99999"}));
}

TEST(ImageIo, ScalarsAndVectorsAreNotMistakenForEachOther) {
  const ScratchFolder folder;
  write_image(folder / "s.nii", wavy_image());
  EXPECT_THROW(read_vector_image(folder / "s.nii"), std::invalid_argument);
  write_image(folder / "v.nii", VectorImage{wavy_image().geometry, std::vector<std::array<float, 3>>(24 * 24 * 24)});
  EXPECT_THROW(read_image(folder / "v.nii"), std::invalid_argument);
}

TEST(ImageIo, AMissingFileOrFolderIsAFaultWithAName) {
  const ScratchFolder folder;
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_image(folder / "no.nii"); }, {"no.nii", "no such file"}));
  EXPECT_TRUE(
      throws_saying<std::runtime_error>([&] { write_image(folder / "no/a.nii.gz", wavy_image()); }, {"a.nii.gz"}));
  EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { write_image(folder / "a.png", wavy_image()); }, {".nrrd"}));
}

}  // namespace brainshift::test::read_image_test
