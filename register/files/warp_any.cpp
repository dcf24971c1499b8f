// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_any.hpp"

#include <stdexcept>
#include <string>

#include "register/warp/warp.hpp"
#include "segmentation/files/points_file.hpp"
#include "segmentation/files/surface_file.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

bool ends_with(const fs::path& file, const char* ending) {
  return file.string().ends_with(ending);
}

bool is_surface(const fs::path& file) {
  return ends_with(file, ".vtp") || ends_with(file, ".stl") || ends_with(file, ".ply") || ends_with(file, ".obj");
}

void warp_points(const fs::path& in, const fs::path& out, const VectorImage& forward) {
  const PointsFile points(in);
  if (!is_points_file(out) || out.extension() != in.extension()) {
    throw std::invalid_argument(out.string() + ": the moved points of " + in.string() +
                                " keep its format; write to a " + in.extension().string() + " file");
  }
  points.write_moved(out, move_points(forward, points.positions()));
}

void warp_image(const fs::path& in, const fs::path& out, const VectorImage& resampling, const WarpAnyOptions& options) {
  if (options.labels) {
    write_image(out, warp(read_label_map(in), resampling));
  } else {
    write_image(out, warp(read_image(in), resampling, options.interpolation));
  }
}

}  // namespace

void warp_any(const fs::path& in, const fs::path& register_folder, const fs::path& out, const WarpAnyOptions& options) {
  if (is_points_file(in)) {
    warp_points(in, out, read_vector_image(register_folder / "preop_to_intraop.nii.gz"));
  } else if (is_surface(in)) {
    Surface surface = read_surface(in);
    surface.vertices = move_points(read_vector_image(register_folder / "preop_to_intraop.nii.gz"), surface.vertices);
    write_surface(out, surface);
  } else {
    warp_image(in, out, read_vector_image(register_folder / "intraop_to_preop.nii.gz"), options);
  }
}

}  // namespace brainshift::registration
