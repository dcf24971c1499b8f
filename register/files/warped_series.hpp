// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "register/files/register_fields.hpp"

namespace brainshift::registration {

/// Writes a warped image as a DICOM series of its own, derived from the one in `source`, into a folder that it makes.
/// Returns why there is none, where the source cannot have one, and throws as write_derived_series().
std::string write_warped_series(const std::filesystem::path& folder, const ScalarImage& warped,
                                const std::filesystem::path& source, Towards towards);

}  // namespace brainshift::registration
