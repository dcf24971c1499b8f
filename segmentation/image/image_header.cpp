// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/image_header.hpp"

#include <iomanip>
#include <sstream>
#include <string>

#include "segmentation/files/deflated.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_values = std::uint64_t{1} << 29;  // 4 GiB as double

void check_shape(const fs::path& file, const ImageHeader& header, std::uint64_t components) {
  bool one_volume = header.size.size() >= 3;
  std::string size;
  double values = static_cast<double>(components);
  for (std::size_t axis = 0; axis < header.size.size(); ++axis) {
    one_volume = one_volume && header.size[axis] > 0 && (axis < 3 || header.size[axis] == 1);
    size += (axis == 0 ? "" : " x ") + std::to_string(header.size[axis]);
    values *= static_cast<double>(header.size[axis]);
  }
  if (!one_volume) {
    refuse(file, "one 3-D volume is needed, the file holds " + size + " voxels; " +
                     (header.size.size() < 3 ? "give it a third axis" : "extract one volume"));
  }
  if (header.components != components) {
    refuse(file, std::to_string(components) + " value(s) a voxel are needed, the file holds " +
                     std::to_string(header.components) +
                     "; of a segmentation in layers export one label map, of colours one channel");
  }
  if (values > static_cast<double>(most_values)) {
    constexpr double bytes_a_value = 30;  // of a whole head at the most, measured on heads of 256³
    std::ostringstream memory;
    memory << std::fixed << std::setprecision(0) << bytes_a_value * values / 1e9;
    refuse(file, "the header promises " + size + " voxels" +
                     (components > 1 ? " of " + std::to_string(components) + " values" : "") +
                     ", which would need some " + memory.str() + " GB of memory; not more than " +
                     std::to_string(most_values) +
                     " values are read: resample the image to coarser voxels, or repair the header if it is damaged");
  }
}

void check_geometry(const fs::path& file, const ImageHeader& header) {
  constexpr double longest = 1e6;  // mm
  const auto within = [](const auto& lengths) {
    return lengths.allFinite() && lengths.cwiseAbs().maxCoeff() < longest;
  };
  if (!within(header.spacing) || !within(header.origin) || !header.direction.allFinite() ||
      !(header.spacing.minCoeff() > 0)) {
    refuse(file,
           "the header's spacing, origin or direction is not finite, beyond a kilometre, or the spacing is not "
           "positive; repair the header");
  }
  if (!is_orthonormal(header.direction)) {
    refuse(file,
           "the header's directions of the axes are not unit vectors at right angles, so the image is sheared or "
           "scaled; resample it onto a grid that is not, or repair the header");
  }
}

void check_length(const fs::path& file, const ImageHeader& header) {
  const std::uint64_t length = fs::file_size(file);
  const std::uint64_t stored = length > header.voxels_at ? length - header.voxels_at : 0;
  if (header.compressed ? header.bytes() > most_deflated * length : header.bytes() > stored) {
    refuse(file, "truncated: the header promises " + std::to_string(header.bytes()) +
                     " bytes of voxels, the file holds " + std::to_string(stored) +
                     (header.compressed ? " compressed ones" : "") + "; copy the file again");
  }
}

}  // namespace

std::uint64_t ImageHeader::values() const {
  std::uint64_t count = components;
  for (const std::uint64_t along : size) {
    count *= along;
  }
  return count;
}

void check_volume(const fs::path& file, const ImageHeader& header, std::uint64_t components) {
  check_shape(file, header, components);
  check_geometry(file, header);
}

void check_header(const fs::path& file, const ImageHeader& header, std::uint64_t components) {
  check_volume(file, header, components);
  check_length(file, header);
}

bool is_orthonormal(const Eigen::Matrix3d& direction, double tolerance) {
  const Eigen::Matrix3d product = direction.transpose() * direction;
  return product.allFinite() && (product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= tolerance;
}

void set_axes(ImageHeader& header, const Eigen::Matrix3d& steps) {
  header.spacing = steps.colwise().norm().transpose();
  header.direction = steps * header.spacing.cwiseInverse().asDiagonal();
}

}  // namespace brainshift
