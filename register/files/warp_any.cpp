// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_any.hpp"

#include <stdexcept>
#include <string>

#include "register/files/points_file.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

bool ends_with(const fs::path& file, const char* ending) {
  return file.string().ends_with(ending);
}

bool is_surface(const fs::path& file) {
  return ends_with(file, ".vtp") || ends_with(file, ".stl") || ends_with(file, ".ply") || ends_with(file, ".obj");
}

/// The ending of a file of points; empty when it is none.
std::string points_ending(const fs::path& file) {
  for (const char* ending : {".mrk.json", ".fcsv", ".csv"}) {
    if (ends_with(file, ending)) {
      return ending;
    }
  }
  return {};
}

void warp_points(const fs::path& in, const fs::path& out, const VectorImage& forward) {
  const std::string ending = points_ending(in);
  if (points_ending(out) != ending) {
    throw std::invalid_argument(out.string() + ": the moved points of " + in.string() +
                                " keep its format; write to a " + ending + " file");
  }
  const MovePoints move = [&](const Points& points) { return move_points(forward, points); };
  if (ending == ".mrk.json") {
    copy_markups(in, out, move);
  } else {
    copy_point_table(in, out, move);
  }
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
  if (!points_ending(in).empty()) {
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
