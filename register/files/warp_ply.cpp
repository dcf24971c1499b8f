// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>
#include <fstream>
#include <optional>

#include "register/files/byte_order.hpp"
#include "register/files/out_stream.hpp"
#include "register/files/text_vertex.hpp"
#include "register/files/warp_mesh.hpp"
#include "segmentation/files/free_name.hpp"
#include "segmentation/files/model_file.hpp"
#include "segmentation/files/ply_claims.hpp"
#include "segmentation/files/readable_file.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

/// The rows of the vertices, which come first in the file.
struct PlyVertices {
  std::string format;
  std::size_t rows = 0;
  std::size_t row_bytes = 0;
  std::vector<PlyProperty> properties;
  std::vector<std::size_t> offsets;  ///< of a property: bytes from the beginning of its row
  std::size_t header_lines = 0;

  std::size_t place_of(const fs::path& file, const char* name) const {
    for (std::size_t p = 0; p < properties.size(); ++p) {
      if (properties[p].name == name) {
        return p;
      }
    }
    refuse(file, std::string("its vertices have no property ") + name + "; is it a .ply model?");
  }
};

PlyVertices vertices_of(const fs::path& file, const PlyHeader& header) {
  if (header.elements.empty() || header.elements.front().name != "vertex") {
    refuse(file, "its vertices do not come first; save it again with another program");
  }
  const PlyElement& element = header.elements.front();
  PlyVertices vertices{.format = header.format,
                       .rows = static_cast<std::size_t>(element.rows),
                       .properties = element.properties,
                       .offsets = {}};
  for (const PlyProperty& property : element.properties) {
    if (property.count_bytes) {
      refuse(file, "a property of its vertices is no single number; save the model without it");
    }
    vertices.offsets.push_back(vertices.row_bytes);
    vertices.row_bytes += property.bytes;
  }
  return vertices;
}

/// Says in the header that more numbers stand behind those of each vertex.
void write_added(const PlyVertices& vertices, const std::vector<PointValues>& added, OutStream& out) {
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::find(vertices.properties, name, &PlyProperty::name) != vertices.properties.end();
  };
  for (const PointValues& each : added) {
    const std::string line = "property float " + free_name(each.name, is_taken) + "\n";
    out.write(line.data(), line.size());
  }
}

/// Copies the header line by line and counts its lines.
void copy_header(std::istream& in, const std::vector<PointValues>& added, PlyVertices& vertices, OutStream& out) {
  std::string line;
  int elements = 0;
  bool ends = false;
  while (!ends && std::getline(in, line)) {
    const std::vector<std::string_view> words = words_in(line);
    const bool begins = !words.empty() && words.front() == "element";
    ends = !words.empty() && words.front() == "end_header";
    if (elements == 1 && (begins || ends)) {
      write_added(vertices, added, out);
    }
    elements += begins ? 1 : 0;
    const std::string with_end = line + "\n";
    out.write(with_end.data(), with_end.size());
    ++vertices.header_lines;
  }
}

void move_text(const fs::path& file, const PlyVertices& vertices, const std::array<std::size_t, 3>& places,
               const Eigen::Vector3d& to_lps, std::istream& in, PointMover& mover, OutStream& out) {
  std::string line;
  for (std::size_t row = 0; row < vertices.rows && std::getline(in, line); ++row) {
    Eigen::Vector3d place;
    std::string moved = with_moved_words(line, places, to_lps, mover, file, vertices.header_lines + row + 1, &place);
    for (const PointValues& each : mover.finite_values(place.transpose())) {
      moved.insert(moved.size() - (moved.ends_with('\r') ? 1 : 0),
                   std::string(" ").append(write_number(each.values[0])));
    }
    moved += in.eof() ? "" : "\n";
    out.write(moved.data(), moved.size());
  }
}

template <class Number>
void move_bytes(const fs::path& file, const PlyVertices& vertices, const std::array<std::size_t, 3>& places,
                const Eigen::Vector3d& to_lps, std::istream& in, PointMover& mover, OutStream& out) {
  const bool swapped = (vertices.format == "binary_big_endian") == (std::endian::native == std::endian::little);
  std::vector<char> bytes(vertices.row_bytes);
  for (std::size_t row = 0; row < vertices.rows; ++row) {
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    std::array<Number, 3> x{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::memcpy(&x[axis], bytes.data() + vertices.offsets[places[axis]], sizeof(Number));
    }
    swap_if(swapped, x);
    const Eigen::Vector3d here(x[0], x[1], x[2]);
    if (!in || !here.allFinite()) {
      refuse(file, "vertex " + std::to_string(row + 1) + " is missing or not finite; repair the file");
    }
    const Eigen::Vector3d place = to_lps.cwiseProduct(here);
    const Eigen::Vector3d moved = here + to_lps.cwiseProduct(mover.displacement(place));
    x = {static_cast<Number>(moved[0]), static_cast<Number>(moved[1]), static_cast<Number>(moved[2])};
    swap_if(swapped, x);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::memcpy(bytes.data() + vertices.offsets[places[axis]], &x[axis], sizeof(Number));
    }
    out.write(bytes.data(), bytes.size());
    for (const PointValues& each : mover.finite_values(place.transpose())) {
      std::array<float, 1> value = {static_cast<float>(each.values[0])};
      swap_if(swapped, value);
      out.write(value.data(), sizeof(value));
    }
  }
}

void copy_rest(std::istream& in, OutStream& out) {
  std::array<char, 65536> bytes{};
  while (in.read(bytes.data(), bytes.size()), in.gcount() > 0) {
    out.write(bytes.data(), static_cast<std::size_t>(in.gcount()));
  }
}

}  // namespace

void warp_ply(const fs::path& in, PointMover& mover, const fs::path& out) {
  check_readable(in);
  PlyVertices vertices = vertices_of(in, check_ply_claims(in));
  const Eigen::Vector3d to_lps = axes_to_lps(frame_in_header(in));
  std::ifstream stream(in, std::ios::binary);
  OutStream moved(out);
  copy_header(stream, mover.finite_values(Points(0, 3)), vertices, moved);
  const std::array<std::size_t, 3> places = {vertices.place_of(in, "x"), vertices.place_of(in, "y"),
                                             vertices.place_of(in, "z")};
  const auto all_are = [&](const char* a, const char* b) {
    return std::all_of(places.begin(), places.end(), [&](std::size_t p) {
      return vertices.properties[p].type == a || vertices.properties[p].type == b;
    });
  };
  const bool single = all_are("float", "float32"), twofold = all_are("double", "float64");
  if (vertices.format == "ascii" && (single || twofold)) {
    move_text(in, vertices, places, to_lps, stream, mover, moved);
  } else if (single) {
    move_bytes<float>(in, vertices, places, to_lps, stream, mover, moved);
  } else if (twofold) {
    move_bytes<double>(in, vertices, places, to_lps, stream, mover, moved);
  } else {
    refuse(in, "x, y and z must be float or double; save the model again so");
  }
  if (mover.moved().points == 0) {
    refuse(in, "holds no vertex");
  }
  copy_rest(stream, moved);
  moved.finish();
}

}  // namespace brainshift::registration
