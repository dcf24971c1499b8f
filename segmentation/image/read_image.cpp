// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/itk_bridge.hpp"

#include <itkGDCMImageIO.h>
#include <itkImageFileReader.h>
#include <itkImageSeriesReader.h>
#include <itkVectorImage.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "segmentation/files/readable_file.hpp"
#include "segmentation/image/bytes.hpp"
#include "segmentation/image/dicom_series.hpp"
#include "segmentation/image/field_with_gaps.hpp"
#include "segmentation/image/gzip_file.hpp"
#include "segmentation/image/image_ending.hpp"
#include "segmentation/image/image_format.hpp"
#include "segmentation/image/image_series.hpp"
#include "segmentation/image/name_alone.hpp"
#include "segmentation/image/segments.hpp"
#include "segmentation/image/whole_file.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

template <class Pixel>
using Pointer = typename itk::Image<Pixel, 3>::Pointer;

// What the library makes of a file must be what we checked.
void check_agreement(const fs::path& file, const itk::ImageIOBase& io, const ImageHeader& header) {
  if (io.GetNumberOfComponents() == 1 && header.components == 3) {
    refuse(file,
           "holds three values a voxel, but is no field of vectors in LPS: save it with NIfTI's intent code 1007");
  }
  bool same = io.GetNumberOfComponents() == header.components && io.GetNumberOfDimensions() >= 2;
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) {
    same = same && io.GetDimensions(axis) == (axis < header.size.size() ? header.size[axis] : 1);
  }
  if (!same) {
    refuse(file, "the header contradicts itself on the size of the image; convert it to .nii.gz");
  }
}

template <class Value, class Pixel>
void copy_values(ByteView bytes, bool swapped, itk::Image<Pixel, 3>& image) {
  const std::size_t count = bytes.size() / sizeof(Value);
  for (std::size_t i = 0; i < count; ++i) {
    image.GetBufferPointer()[i] = static_cast<Pixel>(number_at<Value>(bytes, i * sizeof(Value), swapped));
  }
}

ImageGeometry geometry_in(const ImageHeader& header) {
  return {
      .size = {static_cast<int>(header.size[0]), static_cast<int>(header.size[1]), static_cast<int>(header.size[2])},
      .spacing = header.spacing,
      .origin = header.origin,
      .direction = header.direction};
}

// ITK has no reader of FreeSurfer's images.
template <class Pixel>
Pointer<Pixel> read_mgh(const fs::path& file, const ImageHeader& header) {
  const std::uint64_t end = header.voxels_at + header.bytes();
  const std::vector<std::uint8_t> bytes = first_uncompressed(file, end);
  if (bytes.size() < end) {
    refuse(file, "truncated: the header promises " + std::to_string(header.bytes()) +
                     " bytes of voxels, the file holds " + std::to_string(bytes.size() - header.voxels_at) +
                     "; copy the file again");
  }
  const ByteView values = ByteView(bytes).subspan(header.voxels_at);
  auto image = itk::Image<Pixel, 3>::New();
  set_geometry(*image, geometry_in(header));
  if (header.floating) {
    copy_values<float>(values, header.swapped, *image);
  } else if (header.bytes_a_value == 1) {
    copy_values<std::uint8_t>(values, header.swapped, *image);
  } else if (header.bytes_a_value == 2) {
    copy_values<std::int16_t>(values, header.swapped, *image);
  } else {
    copy_values<std::int32_t>(values, header.swapped, *image);
  }
  return image;
}

template <class ItkImageType>
typename ItkImageType::Pointer read_by_itk(const fs::path& file, ImageFormat format, const ImageHeader& header) {
  const NameAlone alone(file, format);
  const auto io = make_image_io(format);
  io->SetFileName(alone.name());
  io->ReadImageInformation();
  check_agreement(file, *io, header);
  auto reader = itk::ImageFileReader<ItkImageType>::New();
  reader->SetImageIO(io);
  reader->SetFileName(alone.name());
  reader->Update();
  return reader->GetOutput();
}

template <class Pixel>
Pointer<Pixel> read_file(const fs::path& file, unsigned components, Gaps gaps) {
  check_readable(file);
  const ImageFormat format = image_format(file);
  const ImageHeader header = check_whole(file, format, components, gaps);
  if (header.turned_vectors) {
    refuse(file, "its vectors are not in LPS, by the header's space or measurement frame; save the field in LPS");
  }
  if constexpr (std::is_arithmetic_v<Pixel>) {
    if (format == ImageFormat::mgh) {
      return read_mgh<Pixel>(file, header);
    }
  }
  return read_by_itk<itk::Image<Pixel, 3>>(file, format, header);
}

/// The slices of one file in the order of their places.
template <class Pixel>
void sort_frames(const std::vector<std::size_t>& frames, itk::Image<Pixel, 3>& image) {
  const auto size = image.GetLargestPossibleRegion().GetSize();
  const std::size_t plane = size[0] * size[1];
  const std::vector<Pixel> stored(image.GetBufferPointer(), image.GetBufferPointer() + plane * frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::copy_n(stored.data() + plane * frames[k], plane, image.GetBufferPointer() + plane * k);
  }
}

template <class Pixel>
Pointer<Pixel> read_dicom(const fs::path& folder, unsigned components) {
  if (components != 1) {
    refuse(folder,
           "a folder with a DICOM series holds one value a voxel; " + std::to_string(components) + " are needed");
  }
  const DicomSeries series = read_dicom_series(folder);
  auto io = itk::GDCMImageIO::New();
  io->SetFileName(series.files.front());
  io->ReadImageInformation();
  if (io->GetNumberOfComponents() != 1 || io->GetDimensions(0) != series.header.size[0] ||
      io->GetDimensions(1) != series.header.size[1] ||
      (!series.frames.empty() && io->GetDimensions(2) != series.header.size[2])) {
    refuse(folder, "a DICOM series of one value a voxel is needed");
  }
  auto reader = itk::ImageSeriesReader<itk::Image<Pixel, 3>>::New();
  reader->SetImageIO(io);
  reader->SetFileNames(series.files);
  reader->Update();
  const Pointer<Pixel> image = reader->GetOutput();
  if (series.header.size[2] > 1) {
    set_grid(*image, geometry_in(series.header));  // ITK has no place of frames
  }
  if (!series.frames.empty()) {
    sort_frames(series.frames, *image);
  }
  return image;
}

// ITK's NIfTI and DICOM readers choose between parts of the header, so what they took is looked at again.
void check_read_geometry(const fs::path& file, const ImageGeometry& geometry) {
  ImageHeader taken;
  for (const int along : geometry.size) {
    taken.size.push_back(static_cast<std::uint64_t>(along));
  }
  taken.spacing = geometry.spacing;
  taken.origin = geometry.origin;
  taken.direction = geometry.direction;
  check_volume(file, taken, 1);
}

/// ITK's exceptions as ours.
template <class Read>
auto naming_faults(const fs::path& file, const Read& read) {
  try {
    return read();
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const itk::MemoryAllocationError&) {
    throw std::bad_alloc();
  } catch (const fs::filesystem_error& fault) {
    refuse(file, "cannot be read (" + fault.code().message() + "); change its permissions, or copy it again");
  } catch (const std::exception&) {
    refuse(file, "cannot be read, damaged or truncated; copy it again, or convert it to .nii.gz");
  }
}

template <class Pixel>
Pointer<Pixel> read_any(const fs::path& file, unsigned components, Gaps gaps = Gaps::refused) {
  std::error_code unknown;
  return naming_faults(file, [&] {
    auto image = fs::is_directory(file, unknown) ? read_dicom<Pixel>(file, components)
                                                 : read_file<Pixel>(file, components, gaps);
    check_read_geometry(file, geometry_of(*image));
    return image;
  });
}

void check_finite(const fs::path& file, const ImageGeometry& geometry, std::span<const float> values,
                  std::size_t components, Gaps gaps = Gaps::refused) {
  const auto bad = [gaps](float value) { return is_fault(value, gaps); };
  const auto first = std::find_if(values.begin(), values.end(), bad);
  if (first != values.end()) {
    const auto voxel = static_cast<std::size_t>(first - values.begin()) / components;
    refuse_not_finite(file, std::count_if(first, values.end(), bad), geometry.size, voxel, gaps);
  }
}

std::uint16_t as_label(const fs::path& file, const Eigen::Array3i& size, std::size_t voxel, double value) {
  constexpr double highest = std::numeric_limits<std::uint16_t>::max();
  if (!(value >= 0 && value <= highest && value == std::floor(value))) {
    refuse(file, voxel_name(size, voxel) + " holds " + write_number(value) +
                     "; labels are whole numbers from 0 to 65535: " +
                     (value > 0 && value < 1 ? "are these probabilities? Give the map of labels"
                      : value < 0 ? "were they saved in another type? Save them as unsigned, or renumber them"
                                  : "renumber or round them"));
  }
  return static_cast<std::uint16_t>(value);
}

}  // namespace

ScalarImage read_image(const fs::path& file) {
  const auto image = from_itk<float>(*read_any<float>(file, 1));
  check_finite(file, image.geometry, image.voxels, 1);
  return image;
}

LabelMap read_label_map(const fs::path& file) {
  const auto values = read_any<double>(file, 1);
  LabelMap labels;
  labels.geometry = geometry_of(*values);
  labels.voxels.resize(labels.geometry.voxel_count());
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    labels.voxels[i] = as_label(file, labels.geometry.size, i, values->GetBufferPointer()[i]);
  }
  return labels;
}

std::vector<LabelMap> read_layers(const fs::path& file) {
  const std::uint64_t count = read_nrrd_header(file).components;
  if (count == 1) {
    return {read_label_map(file)};
  }
  using Layers = itk::VectorImage<float, 3>;  // float holds 65536 and more as it is
  const Layers::Pointer values = naming_faults(file, [&] {
    const ImageHeader header = check_whole(file, ImageFormat::nrrd, count);
    return read_by_itk<Layers>(file, ImageFormat::nrrd, header);
  });
  const ImageGeometry grid = geometry_of(*values);
  check_read_geometry(file, grid);
  std::vector<LabelMap> layers(count, LabelMap{grid, std::vector<std::uint16_t>(grid.voxel_count())});
  for (std::size_t i = 0; i < grid.voxel_count(); ++i) {
    for (std::size_t layer = 0; layer < count; ++layer) {
      layers[layer].voxels[i] = as_label(file, grid.size, i, values->GetBufferPointer()[i * count + layer]);
    }
  }
  return layers;
}

namespace {

VectorImage read_vectors(const fs::path& file, Gaps gaps) {
  auto image = from_itk<std::array<float, 3>>(*read_any<itk::Vector<float, 3>>(file, 3, gaps));
  const std::span<const float> values(image.voxels.front().data(), 3 * image.voxels.size());
  check_finite(file, image.geometry, values, 3, gaps);
  if (const ImageFormat format = image_format(file);
      gaps == Gaps::allowed && (format == ImageFormat::nifti || format == ImageFormat::nifti_gz)) {
    for (const std::size_t value : nifti_nans(file)) {  // components lie one behind the other
      image.voxels[value % image.voxels.size()][value / image.voxels.size()] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return image;
}

}  // namespace

VectorImage read_vector_image(const fs::path& file) {
  return read_vectors(file, Gaps::refused);
}

VectorImage read_field_with_gaps(const fs::path& file) {
  return read_vectors(file, Gaps::allowed);
}

bool is_image_series(const fs::path& file) {
  std::error_code unknown;
  if (!is_nifti_ending(image_ending(file)) || !fs::is_regular_file(file, unknown)) {
    return false;
  }
  check_readable(file);
  const std::vector<std::uint64_t> size = read_nifti_header(file).size;
  return std::any_of(size.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, size.size())), size.end(),
                     [](std::uint64_t along) { return along > 1; });
}

ImageSeries read_image_series(const fs::path& file) {
  using Itk4 = itk::Image<float, 4>;
  const ImageHeader header = check_whole_series(file);
  const Itk4::Pointer image = naming_faults(file, [&] { return read_by_itk<Itk4>(file, image_format(file), header); });
  ImageGeometry grid;
  const auto size = image->GetLargestPossibleRegion().GetSize();
  for (unsigned row = 0; row < 3; ++row) {
    grid.size[row] = static_cast<int>(size[row]);
    grid.spacing[row] = image->GetSpacing()[row];
    grid.origin[row] = image->GetOrigin()[row];
    for (unsigned column = 0; column < 3; ++column) {
      grid.direction(row, column) = image->GetDirection()(row, column);
    }
  }
  check_read_geometry(file, grid);
  ImageSeries series{
      .volumes = {}, .start = header.seconds * image->GetOrigin()[3], .step = header.seconds * image->GetSpacing()[3]};
  for (std::size_t t = 0; t < size[3]; ++t) {
    const float* const begin = image->GetBufferPointer() + t * grid.voxel_count();
    series.volumes.push_back({grid, std::vector<float>(begin, begin + grid.voxel_count())});
    check_finite(file, grid, series.volumes.back().voxels, 1);
  }
  return series;
}

}  // namespace brainshift
