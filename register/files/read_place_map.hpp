// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "register/field/place_map.hpp"

namespace brainshift::registration {

/// What a transform between the preop and the intraop brain moves from preop to intraop: points, whose places it takes
/// from preop to intraop; or images, which it resamples, so that it takes an intraop place to the preop one.
enum class Moves : std::uint8_t { points, image };

/// What the file says of itself: by the names that we write, or by a .json beside it with From, To and Mode as ours.
/// Nothing where neither is there.
std::optional<Moves> known_direction(const std::filesystem::path& file);

/// Reads a map of places: an image of displacements, mm, LPS (.nii, .nii.gz, .nrrd, .mha: what ANTs, elastix and we
/// write), or an ITK transform (is_transform_file()), also one of several. It is not known outside the grid of a field
/// or a B-spline, nor beside a voxel of a field that is NaN. Throws std::invalid_argument, naming the file, when it is
/// missing, damaged, holds no vectors of three components, one that is infinite, or no transform in space.
PlaceMap read_place_map(const std::filesystem::path& file);

}  // namespace brainshift::registration
