// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace brainshift {

/// Of a NIfTI file whose sform and qform place its voxels differently: which was taken, and by how much they differ, as
/// a sentence. Empty where they agree, where there is one of them, and for any other image or no name. Throws
/// std::invalid_argument as read_image() does.
std::string frame_note(const std::filesystem::path& file);

}  // namespace brainshift
