// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_any.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "register/files/warp_gii.hpp"
#include "register/files/warp_mesh.hpp"
#include "register/files/warp_model.hpp"
#include "register/files/warp_tracts.hpp"
#include "register/files/warped_name.hpp"
#include "register/files/warped_series.hpp"
#include "register/warp/cavity_voxels.hpp"
#include "register/warp/from_outside.hpp"
#include "register/warp/recognise_labels.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/points_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/image/image_ending.hpp"
#include "segmentation/image/image_series.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

void warp_points(const fs::path& in, PointMover& mover, const fs::path& out) {
  const PointsFile points(in);
  const Points moved = move_points(mover, points.positions());
  points.write_moved(out, moved, mover.values(points.positions()));
}

void warp_surface(const fs::path& in, PointMover& mover, const fs::path& out) {
  Surface surface = read_surface(in);
  surface.vertices = move_points(mover, surface.vertices);
  write_surface(out, surface);
}

using MoveFile = void (*)(const fs::path& in, PointMover& mover, const fs::path& out);

/// Nothing for an image.
MoveFile mover_of(const fs::path& file) {
  if (is_points_file(file)) {
    return warp_points;
  }
  constexpr std::array<std::pair<std::string_view, MoveFile>, 9> movers = {{{".vtp", warp_model},
                                                                            {".vtu", warp_model},
                                                                            {".vtk", warp_model},
                                                                            {".gii", warp_gii},
                                                                            {".tck", warp_tck},
                                                                            {".trk", warp_trk},
                                                                            {".obj", warp_obj},
                                                                            {".ply", warp_ply},
                                                                            {".stl", warp_surface}}};
  const std::string ending = ending_of(file);
  const auto found =
      std::find_if(movers.begin(), movers.end(), [&](const auto& mover) { return mover.first == ending; });
  return found == movers.end() ? nullptr : found->second;
}

/// Draws 0 where a resection has taken tissue out. Returns of how many voxels.
template <class T>
std::size_t take_out(RegisterFields& fields, Image<T>& image) {
  if (!fields.removed()) {
    return 0;
  }
  const LabelMap there = on_grid(*fields.removed(), image.geometry);
  std::vector<std::size_t> voxels;
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    if (there.voxels[v] != 0) {
      voxels.push_back(v);
    }
  }
  image = emptied(std::move(image), voxels, T{});
  return voxels.size();
}

/// share_from_outside() of an image on its own grid; NaN, too, where nothing moves on the grid that it is drawn on.
double from_outside(const ImageGeometry& image, RegisterFields& fields, const ImageGeometry& grid) {
  const VectorImage& back = fields.of_images();
  const double drawn = share_from_outside(image, back, grid);
  return same_geometry(image, grid) || std::isnan(drawn) ? drawn : share_from_outside(image, back, image);
}

WarpedFile warp_labels(LabelMap labels, RegisterFields& fields, const fs::path& out, const WarpAnyOptions& options) {
  const ImageGeometry grid = options.grid.value_or(labels.geometry);
  const std::size_t removed = take_out(fields, labels);
  write_image(out, warp(labels, fields.of_images(), grid));
  return {.is_image = true,
          .is_label_map = true,
          .grid = grid,
          .moved = {},
          .from_outside = from_outside(labels.geometry, fields, grid),
          .removed = removed};
}

/// Volume by volume, interpolated: labels in time are rare.
WarpedFile warp_series(const fs::path& in, RegisterFields& fields, const fs::path& out, const WarpAnyOptions& options) {
  if (options.values == Values::labels) {
    refuse(in, "label maps of four dimensions are not warped; extract the volumes");
  }
  ImageSeries series = read_image_series(in);
  const ImageGeometry own = series.volumes.front().geometry, grid = options.grid.value_or(own);
  std::size_t removed = 0;
  for (ScalarImage& volume : series.volumes) {
    removed = take_out(fields, volume);
    volume = warp(volume, fields.of_images(), options.interpolation, grid);
  }
  write_image_series(out, series);
  return {.is_image = true,
          .is_label_map = false,
          .grid = grid,
          .moved = {},
          .from_outside = from_outside(own, fields, grid),
          .removed = removed};
}

/// Whether the name is one of an image, as image readers take it; a folder may hold DICOM.
bool may_be_image(const fs::path& file) {
  return fs::is_directory(file) || !image_ending(file).empty();
}

WarpedFile warp_image(const fs::path& in, RegisterFields& fields, const fs::path& out, const WarpAnyOptions& options) {
  if (is_image_series(in)) {
    return warp_series(in, fields, out, options);
  }
  if (options.values == Values::labels) {
    return warp_labels(read_label_map(in), fields, out, options);
  }
  ScalarImage image = read_image(in);
  if (options.values == Values::recognised && looks_like_labels(image)) {
    return warp_labels(read_label_map(in), fields, out, options);
  }
  const ImageGeometry grid = options.grid.value_or(image.geometry);
  const std::size_t removed = take_out(fields, image);
  const ScalarImage warped = warp(image, fields.of_images(), options.interpolation, grid);
  write_image(out, warped);
  WarpedFile result{.is_image = true,
                    .is_label_map = false,
                    .grid = grid,
                    .moved = {},
                    .from_outside = from_outside(image.geometry, fields, grid),
                    .removed = removed};
  if (fs::is_directory(in)) {
    result.no_series = write_warped_series(series_name(out), warped, in, fields.towards());
  }
  return result;
}

}  // namespace

WarpedFile warp_any(const fs::path& in, RegisterFields& fields, const fs::path& out, const WarpAnyOptions& options) {
  const MoveFile move = mover_of(in);
  if (move == nullptr && fs::exists(in) && !may_be_image(in)) {
    refuse(in,
           "its ending is none that is known; give an image (.nii, .nii.gz, .nrrd, .mha, .mgz, a folder with DICOM), a "
           "model (.vtp, .vtu, .vtk, .gii, .stl, .ply, .obj), tracts (.tck, .trk) or points (.mrk.json, .fcsv, .csv)");
  }
  if (move == nullptr) {
    const WarpedFile warped = warp_image(in, fields, out, options);
    for (const auto& [name, image] : fields.values_on(warped.grid)) {
      write_image(values_name(name, out), image);
    }
    return warped;
  }
  if (mover_of(out) != move || ending_of(out) != ending_of(in)) {
    refuse(out,
           "the moved points of " + in.string() + " keep its format; write to a " + in.extension().string() + " file");
  }
  PointMover mover(
      fields.of_points(), [&](const Points& places) { return fields.values_of_points(places); },
      [&](const Eigen::Vector3d& place) { return fields.is_removed(place); });
  move(in, mover, out);
  return {.is_image = false, .is_label_map = false, .grid = {}, .moved = mover.moved()};
}

}  // namespace brainshift::registration
