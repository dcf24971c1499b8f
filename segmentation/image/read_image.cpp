// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/itk_bridge.hpp"

#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImageFileReader.h>
#include <itkImageSeriesReader.h>
#include <itkMetaDataObject.h>

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "segmentation/image/image_format.hpp"
#include "segmentation/image/whole_file.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

void check_present(const fs::path& file) {
  if (!fs::exists(file)) {
    throw std::invalid_argument(file.string() + ": no such file; check the path");
  }
  if (fs::is_regular_file(file) && fs::file_size(file) == 0) {
    throw std::invalid_argument(file.string() + ": the file is empty; copy it again");
  }
}

void check_shape(const fs::path& file, const itk::ImageIOBase& io, unsigned components) {
  const unsigned dimensions = io.GetNumberOfDimensions();
  bool one_volume = dimensions >= 3;
  for (unsigned axis = 3; axis < dimensions; ++axis) {
    one_volume = one_volume && io.GetDimensions(axis) == 1;
  }
  if (!one_volume) {
    std::string size;
    for (unsigned axis = 0; axis < dimensions; ++axis) {
      size += (axis == 0 ? "" : " x ") + std::to_string(io.GetDimensions(axis));
    }
    throw std::invalid_argument(file.string() + ": one 3-D volume is needed, the file holds " + size +
                                " voxels; extract one volume");
  }
  if (io.GetNumberOfComponents() != components) {
    throw std::invalid_argument(file.string() + ": " + std::to_string(components) +
                                " value(s) a voxel are needed, the file holds " +
                                std::to_string(io.GetNumberOfComponents()));
  }
}

void check_geometry(const fs::path& file, const ImageGeometry& geometry) {
  const bool finite = geometry.spacing.allFinite() && geometry.origin.allFinite() && geometry.direction.allFinite();
  if (!finite || !(geometry.spacing.minCoeff() > 0)) {
    throw std::invalid_argument(
        file.string() +
        ": the header's spacing, origin or direction is not finite or the spacing is not positive; repair the header");
  }
}

template <class Pixel>
using Pointer = typename itk::Image<Pixel, 3>::Pointer;

template <class Pixel>
Pointer<Pixel> read_file(const fs::path& file, unsigned components) {
  const ImageFormat format = image_format(file);
  const auto io = make_image_io(format);
  if (!io->CanReadFile(file.c_str())) {
    throw std::invalid_argument(file.string() + ": is not an image of the kind that its ending says, or is damaged");
  }
  io->SetFileName(file.string());
  io->ReadImageInformation();
  check_shape(file, *io, components);
  check_whole(file, format, *io);
  auto reader = itk::ImageFileReader<itk::Image<Pixel, 3>>::New();
  reader->SetImageIO(io);
  reader->SetFileName(file.string());
  reader->Update();
  return reader->GetOutput();
}

std::vector<std::string> dicom_slices(const fs::path& folder) {
  auto names = itk::GDCMSeriesFileNames::New();
  names->SetUseSeriesDetails(false);
  names->SetDirectory(folder.string());
  const auto& series = names->GetSeriesUIDs();
  if (series.size() != 1) {
    throw std::invalid_argument(folder.string() +
                                ": a folder with exactly one DICOM series is needed, this one holds " +
                                std::to_string(series.size()));
  }
  return names->GetFileNames(series.front());
}

template <class Pixel>
Pointer<Pixel> read_dicom(const fs::path& folder, unsigned components) {
  const auto slices = dicom_slices(folder);
  auto io = itk::GDCMImageIO::New();
  io->SetFileName(slices.front());
  io->ReadImageInformation();
  if (components != 1 || io->GetNumberOfComponents() != 1) {
    throw std::invalid_argument(folder.string() + ": a DICOM series of one value a voxel is needed");
  }
  auto reader = itk::ImageSeriesReader<itk::Image<Pixel, 3>>::New();
  reader->SetImageIO(io);
  reader->SetFileNames(slices);
  reader->Update();
  double deviation = 0;
  itk::ExposeMetaData(reader->GetOutput()->GetMetaDataDictionary(), "ITK_non_uniform_sampling_deviation", deviation);
  const double allowed = 0.1 * reader->GetOutput()->GetSpacing()[2];
  if (!(deviation <= allowed)) {
    throw std::invalid_argument(folder.string() + ": the DICOM slices are not evenly spaced (off by " +
                                std::to_string(deviation) + " mm); is a slice missing?");
  }
  return reader->GetOutput();
}

template <class Pixel>
Pointer<Pixel> read_any(const fs::path& file, unsigned components) {
  check_present(file);
  try {
    auto image = fs::is_directory(file) ? read_dicom<Pixel>(file, components) : read_file<Pixel>(file, components);
    check_geometry(file, geometry_of(*image));
    return image;
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::exception& fault) {
    throw std::invalid_argument(file.string() + ": cannot be read, damaged or truncated (" + reason_of(fault) + ")");
  }
}

void check_finite(const fs::path& file, const ImageGeometry& geometry, std::span<const float> values,
                  std::size_t components) {
  const auto bad = [](float value) { return !std::isfinite(value); };
  const auto first = std::find_if(values.begin(), values.end(), bad);
  if (first != values.end()) {
    const auto voxel = static_cast<std::size_t>(first - values.begin()) / components;
    refuse_not_finite(file, std::count_if(first, values.end(), bad), geometry.size, voxel);
  }
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
  constexpr double lowest = std::numeric_limits<std::int16_t>::min();
  constexpr double highest = std::numeric_limits<std::int16_t>::max();
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    const double value = values->GetBufferPointer()[i];
    if (!(value >= lowest && value <= highest && value == std::floor(value))) {
      throw std::invalid_argument(file.string() + ": " + voxel_name(labels.geometry.size, i) + " holds " +
                                  std::to_string(value) + "; labels are whole numbers from -32768 to 32767");
    }
    labels.voxels[i] = static_cast<std::int16_t>(value);
  }
  return labels;
}

VectorImage read_vector_image(const fs::path& file) {
  const auto image = from_itk<std::array<float, 3>>(*read_any<itk::Vector<float, 3>>(file, 3));
  const std::span<const float> values(image.voxels.front().data(), 3 * image.voxels.size());
  check_finite(file, image.geometry, values, 3);
  return image;
}

}  // namespace brainshift
