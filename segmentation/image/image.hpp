// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace brainshift {

/// Where the voxels of an image lie in the world (LPS, mm): x = origin + direction · diag(spacing) · index.
/// Any orthonormal direction is allowed, oblique and left-handed ones too.
struct ImageGeometry {
  Eigen::Array3i size = Eigen::Array3i::Zero();
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();

  std::size_t voxel_count() const {
    return static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()) * static_cast<std::size_t>(size.z());
  }
  std::size_t offset(int i, int j, int k) const {
    const auto nx = static_cast<std::size_t>(size.x());
    const auto ny = static_cast<std::size_t>(size.y());
    return static_cast<std::size_t>(i) + nx * (static_cast<std::size_t>(j) + ny * static_cast<std::size_t>(k));
  }
  /// World position of a (continuous) voxel index; whole indices are voxel centres.
  Eigen::Vector3d to_world(const Eigen::Vector3d& index) const;
  /// Continuous voxel index of a world position.
  Eigen::Vector3d to_index(const Eigen::Vector3d& world) const;
  /// ∂index/∂world, 1/mm: turns a displacement into voxels.
  Eigen::Matrix3d index_from_world() const;
  /// Volume of a voxel, mm³.
  double voxel_volume() const { return spacing.prod(); }
};

/// Same size, and same place to within a thousandth of a voxel.
bool same_geometry(const ImageGeometry& a, const ImageGeometry& b);

/// An image in memory. voxels: size.x × size.y × size.z values, x fastest.
template <class T>
struct Image {
  ImageGeometry geometry;
  std::vector<T> voxels;

  T& at(int i, int j, int k) { return voxels[geometry.offset(i, j, k)]; }
  const T& at(int i, int j, int k) const { return voxels[geometry.offset(i, j, k)]; }
};

using ScalarImage = Image<float>;
using LabelMap = Image<std::uint16_t>;            ///< 0 is background
using VectorImage = Image<std::array<float, 3>>;  ///< displacements, mm, LPS

/// The label at a world position: nearest voxel; a position on the outermost half voxel is inside; 0 outside the image.
std::uint16_t label_at(const LabelMap& labels, const Eigen::Vector3d& world);
/// The same at voxel indices, which need not be whole.
std::uint16_t label_at_index(const LabelMap& labels, const Eigen::Vector3d& index);

/// Whether any voxel carries the label.
bool has_label(const LabelMap& labels, std::int32_t label);

/// The labels on another grid: the nearest at each of its voxels, 0 where the map does not reach. Where several are as
/// near, as on a grid half a voxel away, the one that most of them are.
LabelMap on_grid(const LabelMap& labels, const ImageGeometry& grid);

/// Share of the map's voxels with a label that lie within a grid, 0 to 1; 1 where the map is empty.
double share_within(const LabelMap& labels, const ImageGeometry& grid);

/// "256 x 256 x 256 voxels of 1 x 1 x 1 mm from (-128, 128, 128)", for sentences.
std::string described(const ImageGeometry& geometry);

/// Voxels that the header of a file promises, before any of them is read; empty of a folder of DICOM slices. Throws as
/// read_image().
std::optional<double> declared_voxels(const std::filesystem::path& file);

/// Reads one 3-D scalar image: .nii, .nii.gz, .nrrd, .mha, .mgz, .mgh, or a folder with one DICOM series.
/// Throws std::invalid_argument, naming the file, when it is missing, empty, truncated, no image, not 3-D, or (scalar)
/// holds a value that is not finite, or (labels) one that is no whole number from 0 to 65535.
ScalarImage read_image(const std::filesystem::path& file);
LabelMap read_label_map(const std::filesystem::path& file);
/// A mask, which may be an image of any numbers, as a stripped T1 is: 1 where it is not 0, but for a spline's rings.
/// Throws as read_image() does, and where it holds probabilities: from 0 to 1, most of them near the one or the other.
LabelMap read_mask(const std::filesystem::path& file);
VectorImage read_vector_image(const std::filesystem::path& file);

/// Writes by the file's ending, compressed where the format can. A VectorImage is written as ITK's displacement fields
/// are (vector pixel; intent code 1007 in NIfTI), a LabelMap as int16 where its numbers allow, which every program
/// reads, else as uint16. Throws std::runtime_error, naming the file, when it cannot be written
/// whole.
void write_image(const std::filesystem::path& file, const ScalarImage& image);
void write_image(const std::filesystem::path& file, const LabelMap& image);
void write_image(const std::filesystem::path& file, const VectorImage& image);

}  // namespace brainshift
