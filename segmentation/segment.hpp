// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "segmentation/interface/input.hpp"
#include "segmentation/interface/options.hpp"
#include "segmentation/interface/result.hpp"
#include "segmentation/progress/progress.hpp"

namespace brainshift::segmentation {

/// Writes labels.nii.gz, closed.nii.gz (what closing took in), brain.vtp, skull.vtp, tissue_<label>.vtp and
/// membership_<class>.nii.gz (class 0 is the darkest) into a folder, which is made if need be. Throws
/// std::runtime_error when a file cannot be written whole.
void write_segmentation(const std::filesystem::path& folder, const Segmentation& segmentation);

/// Runs the stage. Throws std::invalid_argument when the input cannot be used, or the edges are too long for the brain
/// (what, why, what to do).
Segmentation segment(const SegmentInput& input, const SegmentOptions& options, const Progress& progress = {});

}  // namespace brainshift::segmentation
