// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace brainshift::registration {

/// The name under which a moved file is written: "warped_" and its own, an image that cannot be written in its own
/// format as .nii.gz.
std::filesystem::path warped_name(const std::filesystem::path& in);

/// Where the values that go along with a warped image (on its grid), .gii (at its vertices) or .tck (at its points) are
/// written: beside it, as "estimated_error_" and its name, a .gii as .shape.gii, a .tck as .tsf.
std::filesystem::path values_name(const std::string& values, const std::filesystem::path& warped);

/// The folder of the DICOM series that a warped image is written as, too, where it was one: beside it, under its name
/// without the ending.
std::filesystem::path series_name(const std::filesystem::path& warped);

}  // namespace brainshift::registration
