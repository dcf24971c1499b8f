// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// Writes steps/NNNNNN.vtu, one a snapshot, of a body that is cut steps/NNNNNN_cut.vtp too (cut_surface.hpp), and
/// steps.pvd that ParaView plays, by the step or, of a transient run, the time in s, into the folder. Throws
/// std::runtime_error, naming the file.
void write_steps(const std::filesystem::path& folder, const SolveResult& result);

}  // namespace brainshift::solve
