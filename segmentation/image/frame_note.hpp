// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace brainshift {

/// What was taken for the place of the voxels, as a sentence: of a NIfTI file whose sform and qform place them
/// differently, or that has neither, of a NRRD that names no space, and of an MGH without a frame. Empty for any other
/// image or no name. Throws std::invalid_argument as read_image() does.
std::string frame_note(const std::filesystem::path& file);

}  // namespace brainshift
