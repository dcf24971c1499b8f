// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solve/interface/model.hpp"

namespace brainshift::solve {

/// A septum from a surface that read_surface() reads. Throws std::invalid_argument, naming the file, when it cannot be
/// read or check_septum() refuses it.
Septum read_septum(const std::filesystem::path& file);

/// Throws std::invalid_argument, naming the septum, when it has no triangle, or one without area, and in a plane
/// problem.
void check_septum(const Septum& septum, bool planar);

}  // namespace brainshift::solve
