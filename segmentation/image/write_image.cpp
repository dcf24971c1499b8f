// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/itk_bridge.hpp"

#include <itkImageFileReader.h>
#include <itkImageFileWriter.h>

#include <fstream>
#include <stdexcept>

#include "segmentation/image/gzip_file.hpp"
#include "segmentation/image/image_format.hpp"
#include "segmentation/image/whole_file.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

template <class ItkImageType>
void write_with_itk(const fs::path& file, const ItkImageType& image) {
  auto writer = itk::ImageFileWriter<ItkImageType>::New();
  writer->SetInput(&image);
  writer->SetImageIO(make_image_io(image_format(file)));
  writer->SetFileName(file.string());
  writer->UseCompressionOn();
  writer->Update();
}

// ITK's writers do not all notice a full disk: what was written must be there.
template <class ItkImageType>
void check_written(const fs::path& file, const ItkImageType& image) {
  if (image_format(file) == ImageFormat::nifti) {
    const auto voxels = image.GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(typename ItkImageType::PixelType);
    if (fs::file_size(file) < 352 + voxels) {
      throw std::runtime_error("the file is shorter than its image");
    }
    return;
  }
  const auto io = make_image_io(image_format(file));
  io->SetFileName(file.string());
  io->ReadImageInformation();
  check_whole(file, image_format(file), *io);
  auto reader = itk::ImageFileReader<ItkImageType>::New();
  reader->SetImageIO(io);
  reader->SetFileName(file.string());
  reader->Update();
}

template <class T>
void write_any(const fs::path& file, const Image<T>& image) {
  const ImageFormat format = image_format(file);
  // ITK compresses NIfTI on one thread at zlib's slow default; ours runs on all of them and checks what it writes.
  const fs::path written = format == ImageFormat::nifti_gz ? fs::path(file.string() + ".part.nii") : file;
  std::error_code ignored;
  try {
    if (!std::ofstream(written, std::ios::binary)) {
      throw std::runtime_error("cannot be opened for writing");
    }
    const auto itk_image = seen_by_itk(image);
    write_with_itk(written, *itk_image);
    check_written(written, *itk_image);
    if (written != file) {
      write_gzip(file, written);
      fs::remove(written, ignored);
    }
  } catch (const std::exception& fault) {
    fs::remove(written, ignored);
    throw std::runtime_error(file.string() +
                             ": could not be written whole; is the disk full or the folder read-only? (" +
                             reason_of(fault) + ")");
  }
}

}  // namespace

void write_image(const fs::path& file, const ScalarImage& image) {
  write_any(file, image);
}
void write_image(const fs::path& file, const LabelMap& image) {
  write_any(file, image);
}
void write_image(const fs::path& file, const VectorImage& image) {
  write_any(file, image);
}

}  // namespace brainshift
