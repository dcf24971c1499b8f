// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace brainshift::registration {

/// The name under which a moved file is written: "warped_" and its own, an image that cannot be written in its own
/// format as .nii.gz.
std::filesystem::path warped_name(const std::filesystem::path& in);

/// Where the estimated error of a warped image (on its grid) or .gii (at its vertices) is written: beside it, under
/// "estimated_error_" and its name.
std::filesystem::path error_name(const std::filesystem::path& warped);

/// The folder of the DICOM series that a warped image is written as, too, where it was one: beside it, under its name
/// without the ending.
std::filesystem::path series_name(const std::filesystem::path& warped);

}  // namespace brainshift::registration
