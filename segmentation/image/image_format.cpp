// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/image_format.hpp"

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <stdexcept>

#include "segmentation/image/image_ending.hpp"

namespace brainshift {

ImageFormat image_format(const std::filesystem::path& file) {
  const std::string_view ending = image_ending(file);
  if (is_nifti_ending(ending)) {
    return ending == ".nii" ? ImageFormat::nifti : ImageFormat::nifti_gz;
  }
  if (ending == ".nrrd") {
    return ImageFormat::nrrd;
  }
  if (ending == ".mha") {
    return ImageFormat::meta;
  }
  if (is_mgh_ending(ending)) {
    return ImageFormat::mgh;
  }
  throw std::invalid_argument(file.string() +
                              ": images end in .nii, .nii.gz, .nrrd, .mha, .mgz or .mgh, or are a folder with one "
                              "DICOM series");
}

itk::ImageIOBase::Pointer make_image_io(ImageFormat format) {
  switch (format) {
    case ImageFormat::nifti:
    case ImageFormat::nifti_gz:
      return itk::NiftiImageIO::New().GetPointer();
    case ImageFormat::nrrd:
      return itk::NrrdImageIO::New().GetPointer();
    case ImageFormat::meta:
      return itk::MetaImageIO::New().GetPointer();
    case ImageFormat::mgh:
      throw std::invalid_argument("images are not written as .mgz or .mgh; choose .nii.gz");
  }
  throw std::logic_error("unknown image format");
}

}  // namespace brainshift
