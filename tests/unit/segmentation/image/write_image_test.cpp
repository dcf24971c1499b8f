// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/itk_bridge.hpp"  // before ITK's headers

#include <gtest/gtest.h>
#include <itkImageFileReader.h>
#include <itkNiftiImageIO.h>

#include "tests/unit/file_size_limit.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"

namespace brainshift::test::write_image_test {

TEST(ImageIo, NiftiOfOursIsReadByItkAtTheSamePlace) {
  const ScratchFolder folder;
  const ScalarImage image = wavy_image();
  write_image(folder / "a.nii.gz", image);
  auto reader = itk::ImageFileReader<itk::Image<float, 3>>::New();
  reader->SetImageIO(itk::NiftiImageIO::New());
  reader->SetFileName((folder / "a.nii.gz").string());
  reader->Update();
  EXPECT_EQ(from_itk<float>(*reader->GetOutput()).voxels, image.voxels);
  EXPECT_TRUE(same_geometry(geometry_of(*reader->GetOutput()), image.geometry));
}

TEST(ImageIo, AnEndingInCapitalsIsWritten) {
  const ScratchFolder folder;
  const ScalarImage image = wavy_image();
  for (const std::string name : {"a.NII", "a.NII.GZ", "a.MHA", "a.NRRD"}) {
    write_image(folder / name, image);
    EXPECT_EQ(read_image(folder / name).voxels, image.voxels) << name;
    std::filesystem::remove(folder / name);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << name;
  }
}

// int16 is what every program reads.
TEST(ImageIo, LabelsAreOf16BitsWithASignUntilTheirNumbersNeedIt) {
  const ScratchFolder folder;
  LabelMap labels = ball(wavy_image().geometry, {40.0, -70.0, 15.0}, 9.0);
  for (const auto& [largest, type] :
       {std::pair<std::uint16_t, itk::IOComponentEnum>(32767, itk::IOComponentEnum::SHORT),
        {32768, itk::IOComponentEnum::USHORT}}) {
    labels.at(1, 2, 3) = largest;
    write_image(folder / "l.nii.gz", labels);
    const auto io = itk::NiftiImageIO::New();
    io->SetFileName((folder / "l.nii.gz").string());
    io->ReadImageInformation();
    EXPECT_EQ(io->GetComponentType(), type) << largest;
  }
}

TEST(ImageIo, AFieldCarriesNiftisVectorIntentAndItkReadsItAsVectors) {
  const ScratchFolder folder;
  VectorImage field{wavy_image().geometry, {}};
  field.voxels.assign(field.geometry.voxel_count(), {1.0F, 2.0F, 3.0F});
  write_image(folder / "f.nii", field);
  std::ifstream header(folder / "f.nii", std::ios::binary);
  header.seekg(68);
  std::int16_t intent = 0;
  header.read(reinterpret_cast<char*>(&intent), sizeof(intent));
  EXPECT_EQ(intent, 1007);
  auto reader = itk::ImageFileReader<itk::Image<itk::Vector<float, 3>, 3>>::New();
  reader->SetImageIO(itk::NiftiImageIO::New());
  reader->SetFileName((folder / "f.nii").string());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetPixel({3, 4, 5})[2], 3.0F);
}

TEST(ImageIo, WhatCannotBeWrittenLeavesEachFileAsItWas) {
  const ScratchFolder folder;
  const ScalarImage image = wavy_image();
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.mha"}) {
    folder.write(name, "of before");
    folder.write(std::string(name) + ".part.nii", "somebody's");
    {
      const FileSizeLimit full(1000);
      EXPECT_TRUE(throws_saying<std::runtime_error>([&] { write_image(folder / name, image); },
                                                    {name, "could not be written whole"}));
    }
    EXPECT_EQ(bytes_of(folder / name), "of before");
    write_image(folder / name, image);
    EXPECT_EQ(read_image(folder / name).voxels, image.voxels) << name;
    EXPECT_EQ(bytes_of(folder / (std::string(name) + ".part.nii")), "somebody's");
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 8) << "nothing half-written";
}

TEST(ImageIo, WhatIsRefusedIsNotTouched) {
  const ScratchFolder folder;
  ScalarImage image = wavy_image();
  folder.write("t1.mgz", "a patient's");
  EXPECT_NE(refusal([&] { write_image(folder / "t1.mgz", image); }).find("choose .nii.gz"), std::string::npos);
  EXPECT_EQ(bytes_of(folder / "t1.mgz"), "a patient's");
  std::filesystem::create_directory(folder / "d.nrrd");
  EXPECT_TRUE(
      throws_saying<std::runtime_error>([&] { write_image(folder / "d.nrrd", image); }, {"d.nrrd: is a folder"}));
  EXPECT_TRUE(std::filesystem::is_directory(folder / "d.nrrd"));
  image.geometry.size = {40000, 1, 1};
  image.voxels.assign(40000, 0);
  EXPECT_NE(refusal([&] { write_image(folder / "long.nii", image); }).find("at most 32767 voxels"), std::string::npos);
}

TEST(ImageIo, ALinkIsFollowed) {
  const ScratchFolder folder;
  const ScalarImage image = wavy_image();
  folder.write("there.nii", "of before");
  std::filesystem::create_symlink(folder / "there.nii", folder / "a.nii");
  write_image(folder / "a.nii", image);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "a.nii"));
  EXPECT_EQ(read_image(folder / "there.nii").voxels, image.voxels);
}

}  // namespace brainshift::test::write_image_test
