// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/whole_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/image/bytes.hpp"
#include "segmentation/image/gzip_file.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

template <class T>
void check_finite(const fs::path& file, ByteView values, const ImageHeader& header, Gaps gaps) {
  std::ptrdiff_t bad = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < values.size() / sizeof(T); ++i) {
    if (is_fault(number_at<T>(values, i * sizeof(T), header.swapped), gaps)) {
      first = bad == 0 ? i : first;
      ++bad;
    }
  }
  if (bad > 0) {
    const Eigen::Array3i size(static_cast<int>(header.size[0]), static_cast<int>(header.size[1]),
                              static_cast<int>(header.size[2]));
    const auto voxels = static_cast<std::size_t>(size.cast<long>().prod());  // components lie one behind the other
    refuse_not_finite(file, bad, size, first % voxels, gaps);
  }
}

/// All numbers of a .nii or .nii.gz, as they stand there.
std::vector<std::uint8_t> nifti_values(const fs::path& file, const ImageHeader& header) {
  constexpr std::size_t padding = std::size_t{1} << 20;
  const std::size_t end = header.voxels_at + header.bytes();
  std::vector<std::uint8_t> bytes =
      header.compressed ? uncompressed(file, end + padding) : first_uncompressed(file, end);
  if (bytes.size() < end) {
    refuse(file, "truncated: the header promises " + std::to_string(header.bytes()) +
                     " bytes of voxels, the file holds " +
                     std::to_string(bytes.size() - std::min<std::size_t>(bytes.size(), header.voxels_at)) +
                     "; copy the file again");
  }
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(header.voxels_at));
  bytes.resize(header.bytes());
  return bytes;
}

void check_nifti_voxels(const fs::path& file, const ImageHeader& header, Gaps gaps) {
  const std::vector<std::uint8_t> values = nifti_values(file, header);
  if (header.floating && header.bytes_a_value == sizeof(float)) {
    check_finite<float>(file, values, header, gaps);
  } else if (header.floating) {
    check_finite<double>(file, values, header, gaps);
  }
}

template <class T>
std::vector<std::size_t> nan_values(ByteView values, bool swapped) {
  std::vector<std::size_t> nan;
  for (std::size_t i = 0; i < values.size() / sizeof(T); ++i) {
    if (std::isnan(number_at<T>(values, i * sizeof(T), swapped))) {
      nan.push_back(i);
    }
  }
  return nan;
}

ImageHeader read_header(const fs::path& file, ImageFormat format) {
  switch (format) {
    case ImageFormat::nifti:
      if (is_gzip(file)) {
        refuse(file, "is compressed; name it .nii.gz");
      }
      return read_nifti_header(file);
    case ImageFormat::nifti_gz:
      return read_nifti_header(file);
    case ImageFormat::meta:
      return read_meta_header(file);
    case ImageFormat::nrrd:
      return read_nrrd_header(file);
    case ImageFormat::mgh:
      return read_mgh_header(file);
  }
  throw std::logic_error("unknown image format");
}

}  // namespace

std::optional<double> declared_voxels(const fs::path& file) {
  std::error_code unknown;
  if (fs::is_directory(file, unknown)) {
    return std::nullopt;
  }
  check_readable(file);
  const ImageHeader header = read_header(file, image_format(file));
  double voxels = 1;
  for (std::size_t axis = 0; axis < std::min<std::size_t>(3, header.size.size()); ++axis) {
    voxels *= static_cast<double>(header.size[axis]);
  }
  return voxels;
}

ImageHeader check_whole(const fs::path& file, ImageFormat format, std::uint64_t components, Gaps gaps) {
  ImageHeader header = read_header(file, format);
  check_header(file, header, components);
  if (format == ImageFormat::nifti || format == ImageFormat::nifti_gz) {
    check_nifti_voxels(file, header, gaps);
  } else if (header.compressed && format != ImageFormat::mgh) {  // our own reader looks at MGH's
    check_inflates(file, header.voxels_at, header.bytes());
  }
  return header;
}

std::vector<std::size_t> nifti_nans(const fs::path& file) {
  const ImageHeader header = read_nifti_header(file);
  if (!header.floating) {
    return {};
  }
  const std::vector<std::uint8_t> values = nifti_values(file, header);
  return header.bytes_a_value == sizeof(float) ? nan_values<float>(values, header.swapped)
                                               : nan_values<double>(values, header.swapped);
}

ImageHeader check_whole_series(const fs::path& file) {
  const ImageHeader header = read_nifti_header(file);
  ImageHeader as_one = header;  // of the same values: the bounds of a volume hold for all of them together
  as_one.size.resize(3);
  check_volume(file, as_one, 1);
  for (std::size_t axis = 3; axis < header.size.size(); ++axis) {
    as_one.size[2] *= std::min(header.size[axis], std::uint64_t{1} << 32U);
    check_header(file, as_one, 1);
  }
  if (header.size.size() != 4) {
    refuse(file, "images of three or four dimensions are read, it has " + std::to_string(header.size.size()));
  }
  check_nifti_voxels(file, header, Gaps::refused);
  return header;
}

std::string voxel_name(const Eigen::Array3i& size, std::size_t offset) {
  const auto nx = static_cast<std::size_t>(size.x());
  const auto ny = static_cast<std::size_t>(size.y());
  return "voxel (" + std::to_string(offset % nx) + ", " + std::to_string(offset / nx % ny) + ", " +
         std::to_string(offset / nx / ny) + ")";
}

void refuse_not_finite(const fs::path& file, std::ptrdiff_t count, const Eigen::Array3i& size, std::size_t first_voxel,
                       Gaps gaps) {
  refuse(file, std::to_string(count) + " value(s) are not finite numbers, the first at " +
                   voxel_name(size, first_voxel) + "; replace them, by " +
                   (gaps == Gaps::refused ? "0 for instance" : "NaN where the field is not known"));
}

}  // namespace brainshift
