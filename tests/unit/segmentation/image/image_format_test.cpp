// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/image_format.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::test::image_format_test {

TEST(ImageFormat, IsThatOfTheEndingInAnyCase) {
  EXPECT_EQ(image_format("a.nii"), ImageFormat::nifti);
  EXPECT_EQ(image_format("folder.mha/a.b.NII"), ImageFormat::nifti);
  EXPECT_EQ(image_format("a.nii.gz"), ImageFormat::nifti_gz);
  EXPECT_EQ(image_format("A.Nii.Gz"), ImageFormat::nifti_gz);
  EXPECT_EQ(image_format("a.nrrd"), ImageFormat::nrrd);
  EXPECT_EQ(image_format("a.mha"), ImageFormat::meta);
  for (const char* name : {"a.mgz", "A.MGH", "a.mgh.gz"}) {
    EXPECT_EQ(image_format(name), ImageFormat::mgh);
  }
}

TEST(ImageFormat, OfAnotherEndingIsRefusedWithTheKnownOnes) {
  for (const std::string name : {"a.gz", "a.png", "nii", "a.nii.bz2", "a.nrrd/b", ""}) {
    const std::string sentence = refusal([&] { image_format(name); });
    EXPECT_TRUE(sentence.starts_with(name + ": images end in .nii, .nii.gz, .nrrd, .mha, .mgz or .mgh")) << sentence;
  }
}

TEST(ImageFormat, HasTheReaderOfItsName) {
  EXPECT_STREQ(make_image_io(ImageFormat::nifti)->GetNameOfClass(), "NiftiImageIO");
  EXPECT_STREQ(make_image_io(ImageFormat::nifti_gz)->GetNameOfClass(), "NiftiImageIO");
  EXPECT_STREQ(make_image_io(ImageFormat::nrrd)->GetNameOfClass(), "NrrdImageIO");
  EXPECT_STREQ(make_image_io(ImageFormat::meta)->GetNameOfClass(), "MetaImageIO");
  EXPECT_THROW(make_image_io(ImageFormat::mgh), std::invalid_argument);
}

}  // namespace brainshift::test::image_format_test
