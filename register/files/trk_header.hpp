// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "segmentation/files/point_values.hpp"

namespace brainshift::registration {

inline constexpr std::size_t trk_header_size = 1000;
using TrkBytes = std::array<char, trk_header_size>;

/// What of a TrackVis header tells how to read the tracts behind it.
struct TrkHeader {
  bool swapped = false;
  int scalars = 0;          ///< a point
  int properties = 0;       ///< a tract
  std::int64_t tracts = 0;  ///< 0: not known
  Eigen::Affine3d to_lps;   ///< from the file's coordinates: voxels scaled to mm, from the corner of the first
};

/// Names more scalars of a point in the header, as many as it has room for, behind those that are there.
/// Returns how many.
int add_scalars(TrkBytes& bytes, const TrkHeader& header, const std::vector<PointValues>& scalars);

/// Throws std::invalid_argument, naming the file, when it is none, of version 1, which knows no place in the world, or
/// a field cannot be.
TrkHeader read_trk_header(const std::filesystem::path& file, const TrkBytes& bytes);

}  // namespace brainshift::registration
