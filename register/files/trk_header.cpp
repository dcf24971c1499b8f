// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/trk_header.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cctype>
#include <cstring>
#include <string>

#include "register/files/byte_order.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

/// The header's fields by their places, in either order of bytes.
struct TrkFields {
  const TrkBytes& bytes;
  bool swapped;

  template <class Number>
  Number at(std::size_t place) const {
    Number value;
    std::memcpy(&value, bytes.data() + place, sizeof(value));
    return swapped ? with_bytes_swapped(value) : value;
  }
  int dimension(int axis) const { return at<std::int16_t>(6 + 2 * static_cast<std::size_t>(axis)); }
  double voxel_size(int axis) const { return at<float>(12 + 4 * static_cast<std::size_t>(axis)); }
  double voxel_to_ras(int row, int column) const {
    return at<float>(440 + 4 * static_cast<std::size_t>(4 * row + column));
  }
  std::string voxel_order() const { return {bytes.data() + 948, strnlen(bytes.data() + 948, 3)}; }
};

/// For each axis of the voxels the letter of the direction that it runs in, as "LPS": of the rotation nearest to the
/// matrix the largest part, each axis of the world taken once.
std::string order_of(const Eigen::Matrix3d& to_ras) {
  const Eigen::Matrix3d scaled = to_ras * to_ras.colwise().norm().cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
  std::string order;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Index row = 0;
    rotation.col(axis).cwiseAbs().maxCoeff(&row);
    order += (rotation(row, axis) > 0 ? "RAS" : "LPI")[row];
    rotation.row(row).setZero();
  }
  return order;
}

/// The pair of directions that a letter belongs to; -1 for any other letter.
int axis_of(char letter) {
  return letter == 'R' || letter == 'L'   ? 0
         : letter == 'A' || letter == 'P' ? 1
         : letter == 'S' || letter == 'I' ? 2
                                          : -1;
}

/// The voxels of the matrix from those of the tracts, whose axes the header may name in another order: a voxel's index
/// along each axis is that along the axis of the same pair, counted from the other end where the letters differ.
Eigen::Affine3d between_orders(const fs::path& file, const std::string& tracts, const std::string& matrix,
                               const Eigen::Vector3d& size) {
  Eigen::Matrix4d between = Eigen::Matrix4d::Identity();
  between.topLeftCorner<3, 3>().setZero();
  for (int to = 0; to < 3; ++to) {
    int found = 0;
    for (int from = 0; from < 3; ++from) {
      if (axis_of(tracts[static_cast<std::size_t>(from)]) != axis_of(matrix[static_cast<std::size_t>(to)])) {
        continue;
      }
      const bool same = tracts[static_cast<std::size_t>(from)] == matrix[static_cast<std::size_t>(to)];
      between(to, from) = same ? 1 : -1;
      between(to, 3) = same ? 0 : size[from] - 1;
      ++found;
    }
    if (found != 1) {
      refuse(file, "the header's voxel order is \"" + tracts + "\"; one such as LPS or RAS is expected");
    }
  }
  return Eigen::Affine3d(between);
}

Eigen::Affine3d to_lps(const fs::path& file, const TrkFields& fields) {
  Eigen::Matrix4d voxel_to_ras;
  Eigen::Vector3d voxel, size;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      voxel_to_ras(row, column) = fields.voxel_to_ras(row, column);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    voxel[axis] = fields.voxel_size(axis);
    size[axis] = fields.dimension(axis);
  }
  const Eigen::Matrix3d axes = voxel_to_ras.topLeftCorner<3, 3>();
  if (!voxel_to_ras.allFinite() || !voxel.allFinite() || !(voxel.minCoeff() > 0) || axes.determinant() == 0 ||
      voxel_to_ras(3, 3) == 0) {
    refuse(file,
           "its header lacks the size of a voxel or vox_to_ras, so nobody knows where its tracts lie; save it "
           "again with a program that writes them");
  }
  std::string order = fields.voxel_order();
  for (char& letter : order) {
    letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  order = order.size() == 3 ? order : "LPS";  // TrackVis' own, where none is named
  const Eigen::Affine3d to_ras = Eigen::Affine3d(voxel_to_ras) * between_orders(file, order, order_of(axes), size) *
                                 Eigen::Translation3d(Eigen::Vector3d::Constant(-0.5)) *
                                 Eigen::Scaling(Eigen::Vector3d(voxel.cwiseInverse()));
  return Eigen::Scaling(-1.0, -1.0, 1.0) * to_ras;
}

}  // namespace

int add_scalars(TrkBytes& bytes, const TrkHeader& header, const std::vector<PointValues>& scalars) {
  constexpr int most = 10;
  constexpr std::size_t count_at = 36, names_at = 38, name_size = 20;
  const int added = std::min(static_cast<int>(scalars.size()), most - header.scalars);
  if (added <= 0) {
    return 0;
  }
  for (int s = 0; s < added; ++s) {
    char* const name = bytes.data() + names_at + name_size * static_cast<std::size_t>(header.scalars + s);
    std::fill_n(name, name_size, '\0');
    scalars[static_cast<std::size_t>(s)].name.copy(name, name_size - 1);
  }
  const auto count = static_cast<std::int16_t>(header.scalars + added);
  const std::int16_t written = header.swapped ? with_bytes_swapped(count) : count;
  std::memcpy(bytes.data() + count_at, &written, sizeof(written));
  return added;
}

TrkHeader read_trk_header(const fs::path& file, const TrkBytes& bytes) {
  constexpr std::int32_t size = trk_header_size;
  TrkFields fields{bytes, false};
  fields.swapped = fields.at<std::int32_t>(996) != size;
  if (std::string(bytes.data(), 5) != "TRACK" || fields.at<std::int32_t>(996) != size) {
    refuse(file, "is no TrackVis file, or its header is damaged; copy it again");
  }
  TrkHeader header;
  header.swapped = fields.swapped;
  header.scalars = fields.at<std::int16_t>(36);
  header.properties = fields.at<std::int16_t>(238);
  header.tracts = fields.at<std::int32_t>(988);
  if (header.scalars < 0 || header.properties < 0 || header.tracts < 0) {
    refuse(file, "the header's number of scalars, properties or tracts is negative; repair the header");
  }
  header.to_lps = to_lps(file, fields);
  return header;
}

}  // namespace brainshift::registration
