// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "segmentation/image/image.hpp"

namespace brainshift {

/// read_vector_image() of a field that need not be known everywhere: where it is not, components are NaN.
VectorImage read_field_with_gaps(const std::filesystem::path& file);

}  // namespace brainshift
