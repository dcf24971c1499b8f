// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/write_slicer_field.hpp"

#include <bit>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>

#include "register/files/out_stream.hpp"
#include "segmentation/files/unfinished_file.hpp"
#include "segmentation/image/gzip_file.hpp"

namespace brainshift::registration {

namespace {

static_assert(std::endian::native == std::endian::little);

std::string header(const ImageGeometry& grid) {
  std::ostringstream text;
  text << std::setprecision(17);
  const auto place = [&text](const Eigen::Vector3d& x) { text << '(' << x[0] << ',' << x[1] << ',' << x[2] << ')'; };
  text << "NRRD0005\n"
       << "type: float\ndimension: 4\nspace: left-posterior-superior\n"
       << "sizes: 3 " << grid.size.x() << ' ' << grid.size.y() << ' ' << grid.size.z() << "\nspace directions: none";
  for (int axis = 0; axis < 3; ++axis) {
    text << ' ';
    place(grid.direction.col(axis) * grid.spacing[axis]);
  }
  text << "\nkinds: vector domain domain domain\nendian: little\nencoding: gzip\nspace origin: ";
  place(grid.origin);
  // Of 3D Slicer: 1006 is a displacement field, no picture of vectors.
  text << "\nintent_code:=1006\ndisplacement field type:=resampling\n\n";
  return text.str();
}

}  // namespace

void write_slicer_field(const std::filesystem::path& file, const VectorImage& resampling) {
  const UnfinishedFile voxels(file, ""), compressed(file, ".gz");  // on the way to the whole one; gone in the end
  std::ofstream plain(voxels.path(), std::ios::binary);
  plain.write(reinterpret_cast<const char*>(resampling.voxels.data()),
              static_cast<std::streamsize>(resampling.voxels.size() * sizeof(resampling.voxels[0])));
  plain.close();
  if (!plain) {
    fail_to_write(file);
  }
  write_gzip(compressed.path(), voxels.path());
  const std::string head = header(resampling.geometry);
  std::ifstream packed(compressed.path(), std::ios::binary);
  OutStream out(file);
  out.write(head.data(), head.size());
  out.write(packed);
  out.finish();
}

}  // namespace brainshift::registration
