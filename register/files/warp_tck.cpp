// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "register/files/byte_order.hpp"
#include "register/files/out_stream.hpp"
#include "register/files/track_scalars.hpp"
#include "register/files/warp_tracts.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/text_lines.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

struct TckHeader {
  std::string datatype;
  std::string place;        ///< "." where the tracts lie in the same file
  std::size_t data_at = 0;  ///< bytes
  std::string lines;        ///< but the first and END

  bool doubles() const { return datatype.starts_with("Float64"); }
  bool swapped() const { return datatype.ends_with("BE") == (std::endian::native == std::endian::little); }
};

/// "key: value" lines up to END.
TckHeader read_tck_header(const fs::path& file, std::istream& in) {
  std::string line;
  if (!std::getline(in, line) || trimmed(line) != "mrtrix tracks") {
    refuse(file, "is no MRtrix tract file: its first line is not \"mrtrix tracks\"");
  }
  TckHeader header;
  while (std::getline(in, line) && trimmed(line) != "END") {
    header.lines += line + "\n";
    const std::size_t colon = line.find(':');
    const std::string_view key = trimmed(std::string_view(line).substr(0, colon));
    const std::string value(colon == std::string::npos ? "" : trimmed(std::string_view(line).substr(colon + 1)));
    if (key == "datatype") {
      header.datatype = value;
    } else if (key == "file") {
      std::istringstream(value) >> header.place >> header.data_at;
    }
  }
  if (!in || header.data_at < static_cast<std::size_t>(in.tellg()) || header.data_at > fs::file_size(file)) {
    refuse(file, "its header lacks END or the place of its tracts, or the file is truncated; copy it again");
  }
  return header;
}

void check_tck(const fs::path& file, const TckHeader& header) {
  const std::string& type = header.datatype;
  if (type != "Float32LE" && type != "Float32BE" && type != "Float64LE" && type != "Float64BE") {
    refuse(file, "its datatype is \"" + type + "\"; Float32LE, Float32BE, Float64LE or Float64BE is expected");
  }
  if (header.place != ".") {
    refuse(file, "its tracts lie in another file, \"" + header.place + "\"; convert it to one file with tckconvert");
  }
}

template <class Number>
std::array<Number, 3> moved_in_ras(const std::array<Number, 3>& place, PointMover& mover, TrackScalars& scalars) {
  const Eigen::Vector3d in_lps(-double{place[0]}, -double{place[1]}, double{place[2]});
  scalars.add(in_lps);
  const Eigen::Vector3d u = mover.displacement(in_lps);
  return {static_cast<Number>(place[0] - u[0]), static_cast<Number>(place[1] - u[1]),
          static_cast<Number>(place[2] + u[2])};
}

/// Three NaN part two tracts, three infinities end them all: both are written as they were read.
template <class Number>
void move_tck(const fs::path& file, std::istream& in, bool swapped, PointMover& mover, TrackScalars& scalars,
              OutStream& out) {
  std::array<Number, 3> place{};
  for (bool at_end = false; !at_end;) {
    if (!in.read(reinterpret_cast<char*>(place.data()), sizeof(place))) {
      refuse(file, "truncated: the mark at the end of the tracts is missing; copy it again");
    }
    std::array<Number, 3> here = place;
    swap_if(swapped, here);
    const auto all = [&](bool (*is)(Number)) { return is(here[0]) && is(here[1]) && is(here[2]); };
    at_end = all([](Number x) { return std::isinf(x); });
    if (all([](Number x) { return std::isfinite(x); })) {
      place = moved_in_ras(here, mover, scalars);
      swap_if(swapped, place);
    } else if (all([](Number x) { return std::isnan(x); })) {
      scalars.end_tract();
    } else if (!at_end) {
      refuse(file, "point " + std::to_string(mover.moved().points + 1) + " is not finite; repair the file");
    }
    out.write(place.data(), sizeof(place));
  }
}

}  // namespace

void warp_tck(const fs::path& in, PointMover& mover, const fs::path& out) {
  check_readable(in);
  std::ifstream stream(in, std::ios::binary);
  const TckHeader header = read_tck_header(in, stream);
  check_tck(in, header);
  std::vector<char> text(header.data_at);
  stream.seekg(0).read(text.data(), static_cast<std::streamsize>(text.size()));
  OutStream moved(out);
  moved.write(text.data(), text.size());
  TrackScalars scalars(out, header.lines, mover);
  if (header.doubles()) {
    move_tck<double>(in, stream, header.swapped(), mover, scalars, moved);
  } else {
    move_tck<float>(in, stream, header.swapped(), mover, scalars, moved);
  }
  moved.finish();
  scalars.finish();
}

}  // namespace brainshift::registration
