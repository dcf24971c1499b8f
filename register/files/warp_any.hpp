// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "register/interface/options.hpp"

namespace brainshift::registration {

struct WarpAnyOptions {
  bool labels = false;  ///< an image is a label map: nearest voxel, whole numbers
  Interpolation interpolation = Interpolation::linear;
};

/// Takes a preop file to the intraoperative brain with the fields of a register folder; what it is, its ending says:
/// - .nii, .nii.gz, .nrrd, .mha, a DICOM folder: an image or label map on any grid, resampled on its own grid;
/// - .vtp, .stl, .ply, .obj: a surface model, its vertices moved (arrays on it are not kept);
/// - .csv (`x,y,z` among its columns, frame named by a line "# frame: LPS" or "# frame: RAS"), .mrk.json, .fcsv:
/// points,
///   moved; everything else in the file stays as it is, the frame too. `out` must have the same ending.
/// Throws std::invalid_argument, naming the file, when it cannot be used, and std::runtime_error when `out` cannot be
/// written whole.
void warp_any(const std::filesystem::path& in, const std::filesystem::path& register_folder,
              const std::filesystem::path& out, const WarpAnyOptions& options = {});

}  // namespace brainshift::registration
