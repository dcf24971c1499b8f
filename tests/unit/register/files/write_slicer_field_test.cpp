// SPDX-License-Identifier: GPL-3.0-or-later
// ITK brings an Eigen of its own, which must be read before ours.
#include <gtest/gtest.h>
#include <itkImageFileReader.h>
#include <itkMetaDataObject.h>
#include <itkNrrdImageIO.h>

#include "register/files/write_slicer_field.hpp"
#include "segmentation/image/itk_bridge.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::write_slicer_field_test {

using namespace builders;
using test::ScratchFolder;

using ItkField = itk::Image<itk::Vector<float, 3>, 3>;

VectorImage waves() {
  return field(grid({9, 8, 7}, {1.6, 1.8, 2.0}, oblique()),
               [](const Eigen::Vector3d& x) { return Eigen::Vector3d(std::sin(x[0]), x[1], 1 / 3.0); });
}

ItkField::Pointer read(const std::filesystem::path& file) {
  const auto reader = itk::ImageFileReader<ItkField>::New();
  reader->SetImageIO(itk::NrrdImageIO::New());
  reader->SetFileName(file.string());
  reader->Update();
  return reader->GetOutput();
}

TEST(WriteSlicerField, ItkReadsTheSameFieldInTheSamePlace) {
  const ScratchFolder folder;
  const VectorImage whole = waves();
  write_slicer_field(folder / "field.nrrd", whole);
  const VectorImage found = from_itk<std::array<float, 3>>(*read(folder / "field.nrrd"));
  EXPECT_TRUE(same_geometry(found.geometry, whole.geometry));
  EXPECT_EQ(found.voxels, whole.voxels);
}

TEST(WriteSlicerField, SaysThatItIsADisplacementFieldThatResamples) {
  const ScratchFolder folder;
  write_slicer_field(folder / "field.nrrd", waves());
  const auto found = read(folder / "field.nrrd");
  std::string intent, type;
  EXPECT_TRUE(itk::ExposeMetaData(found->GetMetaDataDictionary(), "intent_code", intent));
  EXPECT_TRUE(itk::ExposeMetaData(found->GetMetaDataDictionary(), "displacement field type", type));
  EXPECT_EQ(intent, "1006");
  EXPECT_EQ(type, "resampling");
}

TEST(WriteSlicerField, LeavesNothingElseBehind) {
  const ScratchFolder folder;
  write_slicer_field(folder / "field.nrrd", waves());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace brainshift::registration::write_slicer_field_test
