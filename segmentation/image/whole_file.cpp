// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/whole_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>
#include <stdexcept>
#include <vector>

#include "segmentation/image/gzip_file.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;
using ByteView = std::span<const std::uint8_t>;

void refuse_short(const fs::path& file, std::uintmax_t expected, std::uintmax_t found) {
  throw std::invalid_argument(file.string() + ": truncated: the header promises " + std::to_string(expected) +
                              " bytes of voxels, the file holds " + std::to_string(found) + "; copy the file again");
}

// A number at a place in the bytes, which may be in the other byte order.
template <class T>
T number_at(ByteView bytes, std::size_t place, bool swapped) {
  std::array<std::uint8_t, sizeof(T)> raw{};
  std::memcpy(raw.data(), bytes.data() + place, sizeof(T));
  if (swapped) {
    std::reverse(raw.begin(), raw.end());
  }
  return std::bit_cast<T>(raw);
}

template <class T>
void check_finite(const fs::path& file, ByteView values, bool swapped, const itk::ImageIOBase& io) {
  std::ptrdiff_t bad = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < values.size() / sizeof(T); ++i) {
    if (!std::isfinite(number_at<T>(values, i * sizeof(T), swapped))) {
      first = bad == 0 ? i : first;
      ++bad;
    }
  }
  if (bad > 0) {
    const Eigen::Array3i size(static_cast<int>(io.GetDimensions(0)), static_cast<int>(io.GetDimensions(1)),
                              static_cast<int>(io.GetDimensions(2)));
    const auto voxels = static_cast<std::size_t>(size.cast<long>().prod());  // components lie one behind the other
    refuse_not_finite(file, bad, size, first % voxels);
  }
}

// NIfTI's codes.
constexpr std::int16_t float32 = 16, float64 = 64;

// Of one component. The reader, too, goes by the data type and not by the bits of a voxel that stand beside it.
std::size_t bytes_of(std::int16_t datatype) {
  constexpr std::int16_t uint8 = 2, int16 = 4, int32 = 8, rgb = 128, int8 = 256, uint16 = 512, uint32 = 768,
                         int64 = 1024, uint64 = 1280;
  switch (datatype) {
    case uint8:
    case int8:
    case rgb:
      return 1;
    case int16:
    case uint16:
      return 2;
    case int32:
    case uint32:
    case float32:
      return 4;
    case int64:
    case uint64:
    case float64:
      return 8;
    default:
      return 0;  // the reader refuses it
  }
}

void check_nifti(const fs::path& file, const itk::ImageIOBase& io) {
  const std::vector<std::uint8_t> bytes = uncompressed(file);
  constexpr std::size_t header_size = 352;
  if (bytes.size() < header_size) {
    throw std::invalid_argument(file.string() + ": truncated within the header; copy the file again");
  }
  const bool swapped = number_at<std::int32_t>(bytes, 0, false) != 348;
  const auto stored_offset = number_at<float>(bytes, 108, swapped);
  const std::size_t offset = stored_offset > 352.0F ? static_cast<std::size_t>(stored_offset) : header_size;
  const auto datatype = number_at<std::int16_t>(bytes, 70, swapped);
  const std::size_t expected = static_cast<std::size_t>(io.GetImageSizeInComponents()) * bytes_of(datatype);
  const std::size_t found = bytes.size() > offset ? bytes.size() - offset : 0;
  if (found < expected) {
    refuse_short(file, expected, found);
  }
  if (datatype == float32) {
    check_finite<float>(file, ByteView(bytes).subspan(offset, expected), swapped, io);
  }
  if (datatype == float64) {
    check_finite<double>(file, ByteView(bytes).subspan(offset, expected), swapped, io);
  }
}

// The data begin after the line that says LOCAL.
void check_meta(const fs::path& file, const itk::ImageIOBase& io) {
  std::ifstream in(file, std::ios::binary);
  auto expected = static_cast<std::uintmax_t>(io.GetImageSizeInBytes());
  std::string line;
  while (std::getline(in, line) && !line.starts_with("ElementDataFile")) {
    if (line.starts_with("CompressedDataSize")) {
      const std::size_t number = std::min(line.find_first_of("0123456789"), line.size());
      std::from_chars(line.data() + number, line.data() + line.size(), expected);
    }
  }
  const auto begin = in.tellg();
  const auto found = begin < 0 ? 0 : fs::file_size(file) - static_cast<std::uintmax_t>(begin);
  if (found < expected) {
    refuse_short(file, expected, found);
  }
}

}  // namespace

void check_whole(const fs::path& file, ImageFormat format, const itk::ImageIOBase& io) {
  switch (format) {
    case ImageFormat::nifti:
    case ImageFormat::nifti_gz:
      return check_nifti(file, io);
    case ImageFormat::meta:
      return check_meta(file, io);
    case ImageFormat::nrrd:
      return;  // its reader notices
  }
}

std::string voxel_name(const Eigen::Array3i& size, std::size_t offset) {
  const auto nx = static_cast<std::size_t>(size.x());
  const auto ny = static_cast<std::size_t>(size.y());
  return "voxel (" + std::to_string(offset % nx) + ", " + std::to_string(offset / nx % ny) + ", " +
         std::to_string(offset / nx / ny) + ")";
}

void refuse_not_finite(const fs::path& file, std::ptrdiff_t count, const Eigen::Array3i& size,
                       std::size_t first_voxel) {
  throw std::invalid_argument(file.string() + ": " + std::to_string(count) +
                              " value(s) are not finite numbers, the first at " + voxel_name(size, first_voxel) +
                              "; replace them, by 0 for instance");
}

}  // namespace brainshift
