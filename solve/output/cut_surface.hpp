// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solve/cut/inside_body.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// Of a solution's cut; a facet whose middle is outside the body is left out. Throws as parameters_from_displacement().
CutSurface cut_surface(const Solution& solution, const InsideBody& inside);

/// A .vtp: undeformed points with the arrays `displacement` and `side`. Throws std::runtime_error, naming the file,
/// when it cannot be written whole.
void write_cut_surface(const std::filesystem::path& file, const CutSurface& surface);

}  // namespace brainshift::solve
