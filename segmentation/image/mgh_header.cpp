// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <string>

#include "segmentation/files/refuse.hpp"
#include "segmentation/image/bytes.hpp"
#include "segmentation/image/gzip_file.hpp"
#include "segmentation/image/image_header.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t mgh_header_size = 284;

// FreeSurfer writes the highest byte first.
constexpr bool mgh_swapped = std::endian::native == std::endian::little;

int whole_at(ByteView bytes, std::size_t place) {
  return number_at<std::int32_t>(bytes, place, mgh_swapped);
}

Eigen::Vector3d reals(ByteView bytes, std::size_t place) {
  const auto at = [&](std::size_t i) {
    return static_cast<double>(number_at<float>(bytes, place + 4 * i, mgh_swapped));
  };
  return {at(0), at(1), at(2)};
}

void read_type(const fs::path& file, int type, ImageHeader& header) {
  switch (type) {
    case 0:
      header.bytes_a_value = 1;
      return;
    case 1:
      header.bytes_a_value = 4;
      return;
    case 3:
      header.bytes_a_value = 4;
      header.floating = true;
      return;
    case 4:
      header.bytes_a_value = 2;
      return;
    default:
      refuse(file, "holds values of FreeSurfer's type " + std::to_string(type) +
                       "; 0 (uchar), 1 (int), 3 (float) and 4 (short) are read");
  }
}

void read_frame(ByteView bytes, ImageHeader& header) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  header.direction << -1, 0, 0, 0, 0, 1, 0, -1, 0;
  if (number_at<std::int16_t>(bytes, 28, mgh_swapped) == 1) {
    header.spacing = reals(bytes, 30);
    header.direction << reals(bytes, 42), reals(bytes, 54), reals(bytes, 66);
    centre = reals(bytes, 78);
  } else {
    header.frame_note =
        std::string(no_frame) +
        "goodRASFlag is not set; voxels of 1 mm and slices from front to back were taken, as FreeSurfer "
        "does";
  }
  const Eigen::Vector3d ras_to_lps(-1, -1, 1);
  header.direction = ras_to_lps.asDiagonal() * header.direction;
  const Eigen::Vector3d half =
      0.5 * Eigen::Vector3d(static_cast<double>(header.size[0]), static_cast<double>(header.size[1]),
                            static_cast<double>(header.size[2]));
  header.origin = ras_to_lps.cwiseProduct(centre) - header.direction * header.spacing.cwiseProduct(half);
}

}  // namespace

ImageHeader read_mgh_header(const fs::path& file) {
  const std::vector<std::uint8_t> bytes = first_uncompressed(file, mgh_header_size);
  if (bytes.size() < mgh_header_size) {
    refuse(file, "truncated within the header; copy the file again");
  }
  if (whole_at(bytes, 0) != 1) {
    refuse(file, "is no FreeSurfer image, or its header is damaged; copy it again, or convert it to .nii.gz");
  }
  ImageHeader header;
  for (const std::size_t place : {4, 8, 12, 16}) {
    const int along = whole_at(bytes, place);
    if (along < 1) {
      refuse(file, "the header says " + std::to_string(along) + " voxels along an axis; repair the header");
    }
    header.size.push_back(static_cast<std::uint64_t>(along));
  }
  read_type(file, whole_at(bytes, 20), header);
  read_frame(bytes, header);
  header.voxels_at = mgh_header_size;
  header.compressed = is_gzip(file);
  header.swapped = mgh_swapped;
  return header;
}

}  // namespace brainshift
