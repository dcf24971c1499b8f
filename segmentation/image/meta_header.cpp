// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>

#include "segmentation/files/refuse.hpp"
#include "segmentation/files/text_lines.hpp"
#include "segmentation/image/image_header.hpp"
#include "segmentation/image/text_header.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

bool is_true(const std::string& word) {
  return !word.empty() && std::string_view("tT1").find(word.front()) != std::string_view::npos;
}

// MetaIO takes lines into buffers of its own, and of two fields of one name the last.
HeaderFields read_meta_fields(const fs::path& file) {
  constexpr std::size_t longest_name = 200, longest_line = 4000;
  HeaderFields fields;
  TextHeader header(file);
  std::string name;
  while (name != "ElementDataFile") {
    const std::string_view line = header.next_line();
    const std::size_t sign = line.find('=');
    name = trimmed(line.substr(0, sign));
    if (sign == std::string_view::npos || name.empty() || name.size() > longest_name || line.size() > longest_line) {
      refuse(file, "the header has a line that is no \"Name = value\" of a MetaImage; copy the file again");
    }
    if (!fields.values.emplace(name, trimmed(line.substr(sign + 1))).second) {
      refuse(file, "the header names " + name + " twice; repair the header");
    }
  }
  fields.length = header.place();
  return fields;
}

std::uint64_t meta_value_size(const fs::path& file, const std::string& type) {
  static const std::map<std::string, std::uint64_t> sizes = {
      {"MET_CHAR", 1},      {"MET_UCHAR", 1},      {"MET_SHORT", 2}, {"MET_USHORT", 2},
      {"MET_INT", 4},       {"MET_UINT", 4},       {"MET_LONG", 4},  {"MET_ULONG", 4},
      {"MET_LONG_LONG", 8}, {"MET_ULONG_LONG", 8}, {"MET_FLOAT", 4}, {"MET_DOUBLE", 8}};
  const auto found = sizes.find(type);
  if (found == sizes.end()) {
    refuse(file, "the header's ElementType is none that is read, MET_SHORT or MET_FLOAT for instance; convert it");
  }
  return found->second;
}

// MetaIO writes each axis as a row.
void read_meta_geometry(const fs::path& file, const HeaderFields& fields, ImageHeader& header) {
  const std::size_t dimensions = header.size.size();
  for (const char* name : {"CenterOfRotation", "ElementSize", "ElementSpacing", "Offset", "Origin", "Position"}) {
    if (const auto found = fields.values.find(name); found != fields.values.end()) {
      numbers_in(file, name, found->second, dimensions);
    }
  }
  const auto spacing = fields.value({"ElementSpacing", "ElementSize"});
  const auto origin = fields.value({"Offset", "Position", "Origin"});
  const auto matrix = fields.value({"TransformMatrix", "Rotation", "Orientation"});
  const auto copy = [&](const std::string& text, const char* name, Eigen::Vector3d& to) {
    const auto values = numbers_in(file, name, text, dimensions);
    to = Eigen::Vector3d::Map(values.data());
  };
  const std::string unit = fields.value("DistanceUnits");
  if (!unit.empty() && unit != "mm" && unit != "?") {
    refuse(file, "its unit of length is " + unit + "; save it in millimetres");
  }
  if (!spacing.empty()) {
    copy(spacing, "ElementSpacing", header.spacing);
  }
  if (!origin.empty()) {
    copy(origin, "Offset", header.origin);
  }
  if (!matrix.empty()) {
    const auto values = numbers_in(file, "TransformMatrix", matrix, dimensions * dimensions);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      header.direction.col(static_cast<Eigen::Index>(axis)) = Eigen::Vector3d::Map(values.data() + axis * dimensions);
    }
  }
}

void check_meta_storage(const fs::path& file, const HeaderFields& fields, const ImageHeader& header) {
  const auto is_or_absent = [&](const char* name, double usual) {
    const std::string text = fields.value(name);
    return text.empty() || numbers_in(file, name, text, 1).front() == usual;
  };
  if (!is_or_absent("ElementToIntensityFunctionSlope", 1) || !is_or_absent("ElementToIntensityFunctionOffset", 0)) {
    refuse(file,
           "its values are scaled (ElementToIntensityFunctionSlope, ...Offset), which its library ignores; save it "
           "with the scaled values themselves");
  }
  if (fields.value("ElementDataFile") != "LOCAL") {
    refuse(file, "its voxels are not in the file itself (ElementDataFile is not LOCAL); save it as one .mha");
  }
  const std::string header_size = fields.value("HeaderSize");
  if (!is_true(fields.value("BinaryData")) || (!header_size.empty() && header_size != "0")) {
    refuse(file, "its voxels are not binary (BinaryData), or a HeaderSize is given; save it as a plain .mha");
  }
  const std::string stored = fields.value("CompressedDataSize");
  if (header.compressed && !stored.empty()) {
    const std::uint64_t promised = counts_in(file, "CompressedDataSize", stored, 1).front();
    const std::uint64_t found = fs::file_size(file) - header.voxels_at;
    if (found < promised) {
      refuse(file, "truncated: the header promises " + std::to_string(promised) +
                       " bytes of compressed voxels, the file holds " + std::to_string(found) +
                       "; copy the file again");
    }
  }
}

}  // namespace

ImageHeader read_meta_header(const fs::path& file) {
  const HeaderFields fields = read_meta_fields(file);
  ImageHeader header;
  const std::uint64_t dimensions = counts_in(file, "NDims", fields.value("NDims"), 1).front();
  header.size = counts_in(file, "DimSize", fields.value("DimSize"), dimensions);
  header.bytes_a_value = meta_value_size(file, fields.value("ElementType"));
  if (const auto channels = fields.value("ElementNumberOfChannels"); !channels.empty()) {
    header.components = counts_in(file, "ElementNumberOfChannels", channels, 1).front();
  }
  if (header.size.size() >= 3) {
    read_meta_geometry(file, fields, header);
  }
  header.voxels_at = fields.length;
  header.compressed = is_true(fields.value("CompressedData"));
  check_meta_storage(file, fields, header);
  return header;
}

}  // namespace brainshift
