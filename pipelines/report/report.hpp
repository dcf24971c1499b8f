// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "segmentation/progress/progress.hpp"

namespace brainshift::pipelines {

/// Writes out/index.html, one page that holds its pictures, and the pictures as SVG files beside it, from what a run
/// folder holds: run.json and the artefacts of the stages that ran. Parts that the run did not make are left out, and
/// the page says so. Needs no display. Makes the folder. Throws std::invalid_argument, naming the file, when run_folder
/// is none of a run or a file in it cannot be read, and std::runtime_error when the page cannot be written.
void write_report(const std::filesystem::path& run_folder, const std::filesystem::path& out,
                  const Progress& progress = {});

}  // namespace brainshift::pipelines
