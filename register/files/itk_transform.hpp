// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>

namespace brainshift::registration {

/// Whether a file's name ends as that of an ITK transform: .h5, .hdf5, .tfm, .txt or .mat.
bool is_transform_file(const std::filesystem::path& file);

/// Reads an ITK transform of space, also one of several: where it takes a place, both mm, LPS. Nothing outside the grid
/// of a field or a B-spline, nor where a field is NaN. Throws std::invalid_argument, naming the file, when it is
/// damaged or holds none. Kept free of our Eigen, as ITK brings its own.
std::function<std::optional<std::array<double, 3>>(const std::array<double, 3>&)> read_itk_transform(
    const std::filesystem::path& file);

}  // namespace brainshift::registration
