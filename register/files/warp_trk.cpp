// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <fstream>
#include <string>
#include <vector>

#include "register/files/byte_order.hpp"
#include "register/files/out_stream.hpp"
#include "register/files/trk_header.hpp"
#include "register/files/warp_tracts.hpp"
#include "segmentation/files/readable_file.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

/// Moves the points of a tract, which begin its values with their scalars behind each. Where they were, LPS.
Points move_tract(const fs::path& file, const TrkHeader& header, const Eigen::Affine3d& from_lps, std::size_t points,
                  std::vector<float>& values, PointMover& mover) {
  const std::size_t stride = 3 + static_cast<std::size_t>(header.scalars);
  Points places(static_cast<Eigen::Index>(points), 3);
  for (std::size_t p = 0; p < points; ++p) {
    const Eigen::Map<Eigen::Vector3f> place(values.data() + p * stride);
    const Eigen::Vector3d here = place.cast<double>();
    if (!here.allFinite()) {
      refuse(file, "point " + std::to_string(mover.moved().points + 1) + " is not finite; repair the file");
    }
    const Eigen::Vector3d in_lps = header.to_lps * here;
    places.row(static_cast<Eigen::Index>(p)) = in_lps;
    const Eigen::Vector3d u = from_lps.linear() * mover.displacement(in_lps);
    Eigen::Map<Eigen::Vector3f>(values.data() + p * stride) = (here + u).cast<float>();
  }
  return places;
}

/// The tract's values with the first `added` of more scalars behind those of each point.
std::vector<float> with_scalars(const std::vector<float>& values, const TrkHeader& header, std::size_t points,
                                const std::vector<PointValues>& scalars, int added) {
  const std::size_t stride = 3 + static_cast<std::size_t>(header.scalars);
  std::vector<float> result;
  for (std::size_t p = 0; p < points; ++p) {
    result.insert(result.end(), &values[p * stride], &values[p * stride] + stride);
    for (int s = 0; s < added; ++s) {
      result.push_back(static_cast<float>(scalars[static_cast<std::size_t>(s)].values[p]));
    }
  }
  result.insert(result.end(), values.begin() + static_cast<std::ptrdiff_t>(points * stride), values.end());
  return result;
}

/// The number of points of the next tract; -1 at the end of the file.
std::int64_t next_tract(const fs::path& file, std::istream& in, const TrkHeader& header) {
  std::array<std::int32_t, 1> points{};
  if (!in.read(reinterpret_cast<char*>(points.data()), sizeof(points))) {
    if (in.gcount() != 0) {
      refuse(file, "truncated in the last tract; copy it again");
    }
    return -1;
  }
  swap_if(header.swapped, points);
  const auto left = static_cast<double>(fs::file_size(file)) - static_cast<double>(in.tellg());
  const double bytes = 4.0 * points[0] * (3 + header.scalars) + 4.0 * header.properties;
  if (points[0] < 0 || bytes > left) {
    refuse(file, "truncated or damaged: a tract says to have " + std::to_string(points[0]) +
                     " points, more than the rest of the file; copy it again");
  }
  return points[0];
}

}  // namespace

void warp_trk(const fs::path& in, PointMover& mover, const fs::path& out) {
  check_readable(in);
  std::ifstream stream(in, std::ios::binary);
  TrkBytes bytes{};
  if (!stream.read(bytes.data(), bytes.size())) {
    refuse(in, "is no TrackVis file: it ends within its header; copy it again");
  }
  const TrkHeader header = read_trk_header(in, bytes);
  const Eigen::Affine3d from_lps = header.to_lps.inverse();
  const int added = add_scalars(bytes, header, mover.finite_values(Points(0, 3)));
  OutStream moved(out);
  moved.write(bytes.data(), bytes.size());
  std::int64_t tracts = 0;
  std::vector<float> values;
  for (;; ++tracts) {
    const std::int64_t points = next_tract(in, stream, header);
    if (points < 0) {
      break;
    }
    const auto count = static_cast<std::size_t>(points);
    values.resize(count * (3 + static_cast<std::size_t>(header.scalars)) + static_cast<std::size_t>(header.properties));
    stream.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(4 * values.size()));
    std::array<std::int32_t, 1> written{static_cast<std::int32_t>(points)};
    swap_if(header.swapped, written);
    moved.write(written.data(), sizeof(written));
    swap_if(header.swapped, values);
    const Points places = move_tract(in, header, from_lps, count, values, mover);
    if (added > 0) {
      values = with_scalars(values, header, count, mover.finite_values(places), added);
    }
    swap_if(header.swapped, values);
    moved.write(values.data(), 4 * values.size());
  }
  if (header.tracts > 0 && tracts != header.tracts) {
    refuse(in, "the header promises " + std::to_string(header.tracts) + " tracts, the file holds " +
                   std::to_string(tracts) + "; copy it again");
  }
  moved.finish();
}

}  // namespace brainshift::registration
