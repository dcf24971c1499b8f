// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "register/interface/input.hpp"
#include "register/interface/options.hpp"
#include "register/interface/result.hpp"
#include "segmentation/progress/progress.hpp"

namespace brainshift::registration {

/// Runs the stage: fields on the T1's grid, warped images, measures. Folding and voxels that could not be inverted are
/// counted in the measures, not repaired. Throws std::invalid_argument when labels and T1 do not share a grid, the
/// surface is open or does not meet the image, the solution does not fit the brain, or an option is out of range.
Registration register_images(const RegisterInput& input, const RegisterOptions& options, const Progress& progress = {});

/// Writes warped.nii.gz, warped_labels.nii.gz, the fields intraop_to_preop.nii.gz and preop_to_intraop.nii.gz, the
/// transforms of write_transform_files(), jacobian.nii.gz, removed.nii.gz and landmarks.csv (`label,x,y,z` preop,
/// `intraop_x,…`, `ux,uy,uz`, mm LPS, and of a solution that has it `estimated_error`, mm, empty where it is not known;
/// a landmark without a name of its own has its number, from 1 on) into an existing folder; image, labels, landmarks
/// and what was removed only when there are any. Throws std::runtime_error, naming the file, when one cannot be written
/// whole.
void write_registration(const std::filesystem::path& folder, const Registration& registration);

}  // namespace brainshift::registration
