// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// Names without endings. BIDS has `from` and `to` for the thing that is moved and `mode` for what it is: images take
/// the field that resamples, points the one that goes forward.
inline constexpr const char* image_transform = "from-preop_to-intraop_mode-image_xfm";
inline constexpr const char* point_transform = "from-preop_to-intraop_mode-points_xfm";

/// The transforms for other programs, each cut to the part that moves, and beside each a .json that says what it moves,
/// in which frame and by which command: both as .h5, as write_transform() does, and the one for images as .nrrd for 3D
/// Slicer, whose keys say that it is a displacement field that resamples. Throws std::runtime_error, naming the file,
/// when one cannot be written whole.
void write_transform_files(const std::filesystem::path& folder, const VectorImage& resampling,
                           const VectorImage& forward);

}  // namespace brainshift::registration
