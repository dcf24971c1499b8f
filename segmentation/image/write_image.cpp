// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/itk_bridge.hpp"

#include <fcntl.h>
#include <itkImageFileReader.h>
#include <itkImageFileWriter.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/not_written.hpp"
#include "segmentation/files/unfinished_file.hpp"
#include "segmentation/image/gzip_file.hpp"
#include "segmentation/image/image_format.hpp"
#include "segmentation/image/image_series.hpp"
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

// The libraries say lines of their own on a full disk, so the room is asked for before.
void ask_for_room(const fs::path& file, std::size_t bytes) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  const int fault = descriptor < 0 ? errno : ::posix_fallocate(descriptor, 0, static_cast<off_t>(bytes));
  ::close(descriptor);
  if (descriptor < 0 || fault == ENOSPC || fault == EFBIG || fault == EDQUOT) {
    throw std::runtime_error("has not enough room");
  }
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
  check_whole(file, image_format(file), itk::NumericTraits<typename ItkImageType::PixelType>::GetLength());
  auto reader = itk::ImageFileReader<ItkImageType>::New();
  reader->SetImageIO(io);
  reader->SetFileName(file.string());
  reader->Update();
}

/// Throws std::invalid_argument where the format holds no such image.
template <class ItkImageType>
void check_format(const fs::path& file, const ItkImageType& image) {
  const ImageFormat format = image_format(file);
  make_image_io(format);
  if (format == ImageFormat::nifti || format == ImageFormat::nifti_gz) {
    constexpr itk::SizeValueType most = std::numeric_limits<std::int16_t>::max();
    const auto size = image.GetLargestPossibleRegion().GetSize();
    if (*std::max_element(size.begin(), size.end()) > most) {
      throw std::invalid_argument(file.string() + ": NIfTI holds at most " + std::to_string(most) +
                                  " voxels along an axis; choose .nrrd");
    }
  } else if (ItkImageType::ImageDimension > 3) {
    throw std::invalid_argument(file.string() + ": series are written as .nii or .nii.gz alone");
  }
}

/// ITK compresses NIfTI on one thread at zlib's slow default; ours runs on all of them and checks what it writes. ITK
/// knows no ending in capitals, but what it writes has a name of its own.
template <class ItkImageType>
void write_itk(const fs::path& file, const ItkImageType& image) {
  check_format(file, image);
  const bool compressed = image_format(file) == ImageFormat::nifti_gz;
  UnfinishedFile plain(file, compressed ? ".nii" : ending_of(file));
  try {
    ask_for_room(plain.path(),
                 image.GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(typename ItkImageType::PixelType));
    write_with_itk(plain.path(), image);
    check_written(plain.path(), image);
    if (compressed) {
      UnfinishedFile packed(file, ".nii.gz");
      write_gzip(packed.path(), plain.path());
      packed.finish();
    } else {
      plain.finish();
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const itk::MemoryAllocationError&) {
    throw std::bad_alloc();
  } catch (const std::exception&) {
    fail_to_write(file);
  }
}

template <class T>
void write_any(const fs::path& file, const Image<T>& image) {
  write_itk(file, *seen_by_itk(image));
}

}  // namespace

void write_image(const fs::path& file, const ScalarImage& image) {
  write_any(file, image);
}
void write_image(const fs::path& file, const LabelMap& image) {
  constexpr std::uint16_t highest = std::numeric_limits<std::int16_t>::max();
  if (std::any_of(image.voxels.begin(), image.voxels.end(), [](std::uint16_t label) { return label > highest; })) {
    write_any(file, image);
  } else {
    write_itk(file, *seen_by_itk<std::uint16_t, std::int16_t>(image));
  }
}
void write_image(const fs::path& file, const VectorImage& image) {
  write_any(file, image);
}

void write_image_series(const fs::path& file, const ImageSeries& series) {
  using Itk4 = itk::Image<float, 4>;
  const ImageGeometry& grid = series.volumes.at(0).geometry;
  auto image = Itk4::New();
  Itk4::SizeType size;
  Itk4::SpacingType spacing;
  Itk4::PointType origin;
  Itk4::DirectionType direction;
  direction.SetIdentity();
  for (unsigned row = 0; row < 3; ++row) {
    size[row] = static_cast<itk::SizeValueType>(grid.size[row]);
    spacing[row] = grid.spacing[row];
    origin[row] = grid.origin[row];
    for (unsigned column = 0; column < 3; ++column) {
      direction(row, column) = grid.direction(row, column);
    }
  }
  size[3] = series.volumes.size();
  spacing[3] = series.step > 0 ? series.step : 1;
  origin[3] = series.start;
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
  image->Allocate();
  float* place = image->GetBufferPointer();
  for (const ScalarImage& volume : series.volumes) {
    place = std::copy(volume.voxels.begin(), volume.voxels.end(), place);
  }
  write_itk(file, *image);
}

}  // namespace brainshift
