// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/write_slicer_field.hpp"

#include <bit>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>

#include "register/files/out_stream.hpp"
#include "segmentation/image/gzip_file.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;
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

/// Files on the way to the whole one; gone in the end.
struct Parts {
  fs::path plain, packed;

  explicit Parts(const fs::path& file) : plain(file.string() + ".part"), packed(file.string() + ".part.gz") {}
  ~Parts() {
    std::error_code ignored;
    fs::remove(plain, ignored);
    fs::remove(packed, ignored);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
};

}  // namespace

void write_slicer_field(const fs::path& file, const VectorImage& resampling) {
  const Parts parts(file);
  OutStream plain(parts.plain);
  plain.write(resampling.voxels.data(), resampling.voxels.size() * sizeof(resampling.voxels[0]));
  plain.finish();
  write_gzip(parts.packed, parts.plain);
  const std::string head = header(resampling.geometry);
  std::ifstream packed(parts.packed, std::ios::binary);
  OutStream out(file);
  out.write(head.data(), head.size());
  out.write(packed);
  out.finish();
}

}  // namespace brainshift::registration
