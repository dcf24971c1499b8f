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

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/not_written.hpp"
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

// Makes the file. The libraries say lines of their own on a full disk, so the room is asked for before.
void ask_for_room(const fs::path& file, std::size_t bytes) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    throw std::runtime_error("cannot be opened for writing");
  }
  const int fault = ::posix_fallocate(descriptor, 0, static_cast<off_t>(bytes));
  ::close(descriptor);
  if (fault == ENOSPC || fault == EFBIG || fault == EDQUOT) {
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

/// What ITK writes first. It compresses NIfTI on one thread at zlib's slow default; ours runs on all of them and checks
/// what it writes. It knows no ending in capitals.
fs::path written_first(const fs::path& file) {
  if (image_format(file) == ImageFormat::nifti_gz) {
    return file.string() + ".part.nii";
  }
  return file.extension() == ending_of(file) ? file : fs::path(file.string() + ".part" + ending_of(file));
}

template <class ItkImageType>
void write_itk(const fs::path& file, const ItkImageType& image) {
  const fs::path written = written_first(file);
  std::error_code ignored;
  try {
    ask_for_room(written,
                 image.GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(typename ItkImageType::PixelType));
    write_with_itk(written, image);
    check_written(written, image);
    if (image_format(file) == ImageFormat::nifti_gz) {
      write_gzip(file, written);
      fs::remove(written, ignored);
    } else if (written != file) {
      fs::rename(written, file);
    }
  } catch (const std::bad_alloc&) {
    fs::remove(written, ignored);
    throw;
  } catch (const itk::MemoryAllocationError&) {
    fs::remove(written, ignored);
    throw std::bad_alloc();
  } catch (const std::exception&) {
    fs::remove(written, ignored);
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
