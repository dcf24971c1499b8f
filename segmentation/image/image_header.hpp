// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: what the header of an image's file says, read by us and held against the file before a library sees it.

#include <Eigen/Dense>  // before ITK, which brings an Eigen of its own under the same include guards
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace brainshift {

struct ImageHeader {
  std::vector<std::uint64_t> size;  ///< voxels along each axis, those of space first
  std::uint64_t components = 1;     ///< values a voxel
  std::uint64_t bytes_a_value = 0;
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();        ///< mm
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();         ///< mm, in the file's frame
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();  ///< columns: the axes, in the file's frame
  std::uint64_t voxels_at = 0;                              ///< where the voxels begin, bytes; uncompressed in .nii.gz
  bool compressed = false;
  bool swapped = false;         ///< the other byte order than this machine's; NIfTI and MGH alone
  std::string frame_note = {};  ///< where the file contradicts itself on the place or tells none: what was taken
  bool turned_vectors = false;  ///< of a field: they are not in LPS; NRRD alone
  double seconds = 1;           ///< of a unit of time; NIfTI alone
  bool floating = false;        ///< values are floating-point numbers; NIfTI and MGH alone

  std::uint64_t values() const;
  std::uint64_t bytes() const { return values() * bytes_a_value; }
};

/// Of a .nii or .nii.gz. Throws std::invalid_argument, naming the file, when it is none or a field cannot be.
ImageHeader read_nifti_header(const std::filesystem::path& file);
/// Of a .mgz or .mgh, in LPS.
ImageHeader read_mgh_header(const std::filesystem::path& file);
/// Of a .mha, with the voxels in the same file.
ImageHeader read_meta_header(const std::filesystem::path& file);
/// Of a .nrrd, with the voxels in the same file. Refuses frames other than LPS and RAS: ITK places one in LAS wrongly.
ImageHeader read_nrrd_header(const std::filesystem::path& file);

inline constexpr const char* no_frame = "which side is left is not known, as ";
inline constexpr const char* taken_as_stored = "its axes were taken as they are stored, in LPS";

/// Throws std::invalid_argument, naming the file, unless it promises one 3-D volume of so many values a voxel, not more
/// than fit into memory, with finite lengths and an orthonormal direction.
void check_volume(const std::filesystem::path& file, const ImageHeader& header, std::uint64_t components);

/// The same, and that the file is long enough for its voxels.
void check_header(const std::filesystem::path& file, const ImageHeader& header, std::uint64_t components);

/// Whether the columns are unit vectors at right angles. False for NaN.
bool is_orthonormal(const Eigen::Matrix3d& direction, double tolerance = 1e-3);

/// Takes the spacing and the direction from the steps of the three axes, its columns (mm).
void set_axes(ImageHeader& header, const Eigen::Matrix3d& steps);

}  // namespace brainshift
