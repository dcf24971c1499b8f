// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "register/files/register_fields.hpp"
#include "register/interface/options.hpp"
#include "register/warp/point_mover.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// What the values of an image are.
enum class Values : std::uint8_t { recognised, intensities, labels };

struct WarpAnyOptions {
  Values values = Values::recognised;  ///< labels: nearest voxel, whole numbers
  Interpolation interpolation = Interpolation::linear;
  std::optional<ImageGeometry> grid;  ///< of warped images; their own if absent
};

struct WarpedFile {
  bool is_image = false, is_label_map = false;
  ImageGeometry grid;       ///< of a warped image
  MovedPoints moved;        ///< of what is no image
  double from_outside = 0;  ///< share_from_outside() of an image on its own grid; NaN: nothing moves in what is drawn
  std::size_t removed = 0;  ///< voxels of an image that a resection has taken out: they are drawn as 0
  /// Why an image that was a DICOM series has not become one again.
  std::string no_series = {};
};

/// Takes a file from one brain to the other with the fields of a register folder; what it is, its ending says:
/// - .nii, .nii.gz, .nrrd, .mha, .mgz, a DICOM folder: an image or label map on any grid; a 4-D NIfTI volume by volume;
///   an image of a DICOM folder is written as a series, too (series_name() of warped_name.hpp);
/// - .vtp, .vtu, .vtk: surfaces, lines, points and grids; all arrays stay, "displacement" (mm) joins them;
/// - .tck, .trk: tracts, with all that is kept beside their points;
/// - .gii: GIFTI surfaces, all arrays, metadata and coordinate systems stay;
/// - .obj, .ply: models, all else in them stays; .stl: a surface;
/// - .csv (`x,y,z` among its columns, frame named by a line "# frame: LPS" or "# frame: RAS"), .mrk.json, .fcsv:
/// points. Images are resampled, without what a resection has taken out; all else is moved, in the frame of its file,
/// and keeps what else it holds. `out` must have the same ending. What the run knows of how far the displacement may be
/// off (RegisterFields::values_of_points()) goes along: in models of VTK, .ply and .trk as arrays, in a .csv as
/// columns, in 3D Slicer's markups as words, beside images, .gii and .tck as files (values_name() of warped_name.hpp);
/// .obj and .stl have no place for it. Throws std::invalid_argument, naming the file, when it cannot be used, and
/// std::runtime_error when `out` cannot be written whole.
WarpedFile warp_any(const std::filesystem::path& in, RegisterFields& fields, const std::filesystem::path& out,
                    const WarpAnyOptions& options = {});

}  // namespace brainshift::registration
