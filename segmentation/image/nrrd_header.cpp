// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/text_lines.hpp"
#include "segmentation/image/image_header.hpp"
#include "segmentation/image/text_header.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

// Its library copies long fields past the end of a buffer. Values of users ("key:=value") it takes at any length, and
// 3D Slicer's are long.
void read_nrrd_line(const fs::path& file, std::string_view line, HeaderFields& fields) {
  constexpr std::size_t longest = 500;
  if (line.starts_with('#')) {
    return;
  }
  const std::size_t sign = line.find(':');
  const bool of_user = sign != std::string_view::npos && line.substr(sign).starts_with(":=");
  if ((of_user ? sign : line.size()) > longest) {
    refuse(file, "the header has a line of more than " + std::to_string(longest) + " characters; repair the header");
  }
  if (of_user) {
    return;
  }
  if (sign == std::string_view::npos) {
    refuse(file, "the header has a line that is no \"field: value\" of a NRRD; copy the file again");
  }
  const std::string name = in_lower_case(std::string(trimmed(line.substr(0, sign))));
  if (!fields.values.emplace(name, trimmed(line.substr(sign + 1))).second) {
    refuse(file, "the header has a field twice; repair the header");
  }
}

// The names in lower case.
HeaderFields read_nrrd_fields(const fs::path& file) {
  HeaderFields fields;
  TextHeader header(file);
  if (!header.next_line().starts_with("NRRD000")) {
    refuse(file, "is no NRRD image, or its header is damaged; copy the file again");
  }
  for (std::string_view line = header.next_line(); !line.empty(); line = header.next_line()) {
    read_nrrd_line(file, line, fields);
  }
  fields.length = header.place();
  return fields;
}

std::uint64_t nrrd_value_size(const fs::path& file, const std::string& type) {
  static const std::map<std::string, std::uint64_t> sizes = {
      {"int8", 1},     {"int8_t", 1},   {"uint8", 1},     {"uint8_t", 1}, {"uchar", 1}, {"char", 1},    {"int16", 2},
      {"int16_t", 2},  {"uint16", 2},   {"uint16_t", 2},  {"ushort", 2},  {"short", 2}, {"int32", 4},   {"int32_t", 4},
      {"uint32", 4},   {"uint32_t", 4}, {"uint", 4},      {"int", 4},     {"int64", 8}, {"int64_t", 8}, {"uint64", 8},
      {"uint64_t", 8}, {"longlong", 8}, {"ulonglong", 8}, {"float", 4},   {"double", 8}};
  // "unsigned short int" is "short" here, as only its size is asked for.
  std::string name;
  std::istringstream words(in_lower_case(type));
  for (std::string word; words >> word;) {
    if (word != "signed" && word != "unsigned" && (word != "int" || name.empty())) {
      name += word;
    }
  }
  const auto found = sizes.find(name);
  if (found == sizes.end()) {
    refuse(file, "the header's type is none that is read, \"short\" or \"float\" for instance; convert it");
  }
  return found->second;
}

// "(1,0,0) none (0,1,0)": a vector a word, none where an axis is not one of space.
using NrrdVector = std::optional<Eigen::Vector3d>;
std::vector<NrrdVector> vectors_in(const fs::path& file, const std::string& field, const std::string& text) {
  std::vector<NrrdVector> vectors;
  for (std::size_t place = text.find_first_not_of(' '); place != std::string::npos;
       place = text.find_first_not_of(' ', place)) {
    if (text.compare(place, 4, "none") == 0) {
      vectors.emplace_back();
      place += 4;
      continue;
    }
    const std::size_t end = text.find(')', place);
    if (text[place] != '(' || end == std::string::npos) {
      refuse(file, "the header's " + field + " is not made of vectors like (1,0,0); repair the header");
    }
    std::string inner = text.substr(place + 1, end - place - 1);
    std::replace(inner.begin(), inner.end(), ',', ' ');
    const auto values = numbers_in(file, field, inner, 3);
    vectors.emplace_back(Eigen::Vector3d::Map(values.data()));
    place = end + 1;
  }
  return vectors;
}

bool is_component_kind(const std::string& kind) {
  static const std::set<std::string> of_places = {"domain", "space", "time", "???", "none"};
  return !of_places.contains(kind);
}

// Which axis holds the components of a voxel.
std::optional<std::size_t> component_axis(const fs::path& file, const HeaderFields& fields, std::size_t dimensions) {
  std::optional<std::size_t> found;
  std::istringstream kinds(in_lower_case(fields.value("kinds")));
  std::string kind;
  for (std::size_t axis = 0; kinds >> kind; ++axis) {
    if (!is_component_kind(kind)) {
      continue;
    }
    if (found || axis >= dimensions) {
      refuse(file, "the header's kinds name more than one axis of components; extract one volume");
    }
    found = axis;
  }
  return found;
}

std::vector<NrrdVector> steps_along_axes(const std::vector<double>& spacings, std::optional<std::size_t> components) {
  std::vector<NrrdVector> steps;
  for (std::size_t axis = 0; axis < spacings.size(); ++axis) {
    const std::size_t of_space = axis - (components && *components < axis ? 1 : 0);
    steps.emplace_back(spacings[axis] *
                       Eigen::Vector3d::Unit(std::min<Eigen::Index>(2, static_cast<Eigen::Index>(of_space))));
  }
  return steps;
}

void read_nrrd_geometry(const fs::path& file, const HeaderFields& fields, std::optional<std::size_t> components,
                        ImageHeader& header) {
  if (const auto origin = vectors_in(file, "space origin", fields.value("space origin")); !origin.empty()) {
    header.origin = origin.front().value_or(header.origin);
  }
  auto steps = vectors_in(file, "space directions", fields.value("space directions"));
  if (const std::string spacings = fields.value("spacings"); steps.empty() && !spacings.empty()) {
    steps =
        steps_along_axes(numbers_in(file, "spacings", spacings, header.size.size() + (components ? 1 : 0)), components);
  }
  if (steps.empty()) {
    return;
  }
  if (components && *components < steps.size()) {
    steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(*components));
  }
  if (steps.size() != header.size.size() || !steps[0] || !steps[1] || !steps[2]) {
    refuse(file, "the header does not give a direction for each axis of space; repair the header");
  }
  Eigen::Matrix3d axes;
  axes << *steps[0], *steps[1], *steps[2];
  set_axes(header, axes);
}

// ITK turns RAS into LPS. It takes LAS for another frame, and all else for LPS.
void check_nrrd_frame(const fs::path& file, const HeaderFields& fields, ImageHeader& header) {
  static const std::set<std::string> known = {"left-posterior-superior", "lps", "right-anterior-superior", "ras"};
  static const std::set<std::string> units = {"\"mm\"", "mm", "\"millimeter\"", "\"millimetre\"", "\"\""};
  const std::string space = in_lower_case(fields.value("space"));
  if (space.empty() || space == "3d-right-handed") {
    header.frame_note = std::string(no_frame) + "no anatomical space is named; " + taken_as_stored;
  } else if (!known.contains(space)) {
    refuse(file, "the header's space is " + space + "; save the image in left-posterior-superior, as 3D Slicer does");
  }
  std::istringstream words(in_lower_case(fields.value("space units")));
  for (std::string unit; words >> unit;) {
    if (!units.contains(unit)) {
      refuse(file, "the header's unit of length is " + unit + ", not \"mm\"; save the image in mm");
    }
  }
}

// ITK leaves vectors as they are, whatever the frame.
bool has_turned_vectors(const fs::path& file, const HeaderFields& fields) {
  const std::string frame = fields.value("measurement frame");
  const auto axes = vectors_in(file, "measurement frame", frame);
  bool turned = in_lower_case(fields.value("space")).starts_with("r") || (!frame.empty() && axes.size() != 3);
  for (std::size_t i = 0; i < axes.size() && !turned; ++i) {
    turned = !axes[i] || !axes[i]->isApprox(Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i)), 1e-4);
  }
  return turned;
}

void check_nrrd_storage(const fs::path& file, const HeaderFields& fields) {
  const auto is_zero = [&](const char* name) { return fields.value(name).empty() || fields.value(name) == "0"; };
  if (!fields.value("data file").empty() || !fields.value("datafile").empty() || !is_zero("line skip") ||
      !is_zero("lineskip") || !is_zero("byte skip") || !is_zero("byteskip")) {
    refuse(file, "its voxels do not follow its header (data file, line skip or byte skip); save it as one .nrrd");
  }
  if (fields.values.contains("block size") || fields.values.contains("blocksize")) {
    refuse(file, "its voxels are blocks of bytes; convert it");
  }
}

bool is_compressed_nrrd(const fs::path& file, const std::string& encoding) {
  if (encoding != "raw" && encoding != "gzip" && encoding != "gz") {
    refuse(file, "the header's encoding is neither raw nor gzip; save it with one of them");
  }
  return encoding != "raw";
}

}  // namespace

ImageHeader read_nrrd_header(const fs::path& file) {
  const HeaderFields fields = read_nrrd_fields(file);
  ImageHeader header;
  const std::uint64_t dimensions = counts_in(file, "dimension", fields.value("dimension"), 1).front();
  header.size = counts_in(file, "sizes", fields.value("sizes"), dimensions);
  header.bytes_a_value = nrrd_value_size(file, fields.value("type"));
  const auto components = component_axis(file, fields, header.size.size());
  if (components) {
    header.components = header.size[*components];
    header.size.erase(header.size.begin() + static_cast<std::ptrdiff_t>(*components));
    header.turned_vectors = header.components == 3 && has_turned_vectors(file, fields);
  }
  if (header.size.size() >= 3) {
    check_nrrd_frame(file, fields, header);
    read_nrrd_geometry(file, fields, components, header);
  }
  check_nrrd_storage(file, fields);
  header.voxels_at = fields.length;
  header.compressed = is_compressed_nrrd(file, in_lower_case(fields.value("encoding")));
  return header;
}

}  // namespace brainshift
