// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/markups.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "solve/load/frame.hpp"
#include "solve/load/text_lines.hpp"

namespace brainshift::solve {
namespace {

using nlohmann::json;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw std::invalid_argument(file.string() + ": " + what);
}

const json& member(const json& object, const char* name, const std::filesystem::path& file) {
  if (!object.is_object() || !object.contains(name)) {
    fail(file, "is no 3D Slicer markup: \"" + std::string(name) + "\" is missing");
  }
  return object.at(name);
}

Frame frame_of(const json& markup, const std::filesystem::path& file) {
  const json& system = member(markup, "coordinateSystem", file);
  const auto frame = frame_named(system.is_string() ? system.get<std::string>() : system.dump());
  if (!frame) {
    fail(file, "coordinateSystem must be LPS or RAS, found " + system.dump());
  }
  return *frame;
}

void check_units(const json& markup, const std::filesystem::path& file) {
  if (!markup.contains("coordinateUnits")) {
    return;
  }
  const json& units = markup.at("coordinateUnits");
  if (units != "mm" && !(units.is_array() && !units.empty() && units.front() == "mm")) {
    fail(file, "coordinateUnits must be mm, found " + units.dump());
  }
}

Eigen::RowVector3d position_of(const json& point, const std::string& which, const std::filesystem::path& file) {
  if (point.contains("positionStatus") && point.at("positionStatus") != "defined") {
    fail(file,
         which + " has not been placed (positionStatus " + point.at("positionStatus").dump() + "); place or delete it");
  }
  const json& position = member(point, "position", file);
  if (!position.is_array() || position.size() != 3 ||
      !std::all_of(position.begin(), position.end(), [](const json& c) { return c.is_number(); })) {
    fail(file, which + " must have a position of three numbers, found " + position.dump());
  }
  const Eigen::RowVector3d place(position[0].get<double>(), position[1].get<double>(), position[2].get<double>());
  if (!place.allFinite()) {
    fail(file, which + " has a position that is not finite");
  }
  return place;
}

Markup read_json(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  const json document = [&] {
    try {
      return json::parse(text);
    } catch (const json::exception& fault) {
      fail(file, std::string("is no JSON: ") + fault.what());
    }
  }();
  const json& lists = member(document, "markups", file);
  if (!lists.is_array() || lists.size() != 1) {
    fail(file, "one markup list is expected, found " + std::to_string(lists.is_array() ? lists.size() : 0));
  }
  const Frame frame = frame_of(lists[0], file);
  check_units(lists[0], file);
  const json& points = member(lists[0], "controlPoints", file);
  if (!points.is_array()) {
    fail(file, "controlPoints must be a list");
  }
  Markup markup{Points(static_cast<Eigen::Index>(points.size()), 3), {}};
  for (std::size_t n = 0; n < points.size(); ++n) {
    const bool labelled = points[n].is_object() && points[n].contains("label") && points[n].at("label").is_string();
    markup.labels.push_back(labelled ? points[n].at("label").get<std::string>() : "");
    const std::string which = "control point " + std::to_string(n + 1) + " (\"" + markup.labels.back() + "\")";
    if (!points[n].is_object()) {
      fail(file, which + " is no object");
    }
    markup.positions.row(static_cast<Eigen::Index>(n)) = position_of(points[n], which, file);
  }
  to_lps(markup.positions, frame);
  return markup;
}

/// The value of a comment line "# key = value", if it is such a line.
std::optional<std::string> comment_value(std::string_view line, std::string_view key) {
  line = trimmed(line.substr(1));
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos || trimmed(line.substr(0, equals)) != key) {
    return std::nullopt;
  }
  return std::string(trimmed(line.substr(equals + 1)));
}

/// What the comment lines of a .fcsv file say.
struct FcsvHeader {
  std::optional<Frame> frame;
  std::size_t x = 1, y = 2, z = 3, label = 11;  ///< columns
};

std::size_t column(const std::vector<std::string>& names, const std::string& name, const std::filesystem::path& file,
                   std::size_t line) {
  const auto place = std::find(names.begin(), names.end(), name);
  if (place == names.end()) {
    fail_at_line(file, line, "column \"" + name + "\" is missing");
  }
  return static_cast<std::size_t>(place - names.begin());
}

void read_comment(const std::string& comment, const std::filesystem::path& file, std::size_t line, FcsvHeader& header) {
  if (const auto system = comment_value(comment, "CoordinateSystem")) {
    header.frame = frame_named(*system);
    if (!header.frame) {
      fail_at_line(file, line, "CoordinateSystem must be LPS, RAS, 1 or 0, found \"" + *system + "\"");
    }
  }
  if (const auto names = comment_value(comment, "columns")) {
    const std::vector<std::string> fields = split_fields(*names);
    header.x = column(fields, "x", file, line);
    header.y = column(fields, "y", file, line);
    header.z = column(fields, "z", file, line);
    header.label = column(fields, "label", file, line);
  }
}

Markup read_fcsv(const std::filesystem::path& file) {
  const std::vector<std::string> lines = read_lines(file);
  FcsvHeader header;
  std::vector<Eigen::RowVector3d> places;
  Markup markup;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    if (lines[n].starts_with('#')) {
      read_comment(lines[n], file, n + 1, header);
      continue;
    }
    if (!header.frame) {
      fail_at_line(file, n + 1, "a line \"# CoordinateSystem = LPS\" or RAS is expected before the points");
    }
    const std::vector<std::string> fields = split_fields(lines[n]);
    if (fields.size() <= std::max({header.x, header.y, header.z, header.label})) {
      fail_at_line(file, n + 1, "a point with all its columns is expected, found \"" + lines[n] + "\"");
    }
    places.emplace_back(parse_number(fields[header.x], file, n + 1), parse_number(fields[header.y], file, n + 1),
                        parse_number(fields[header.z], file, n + 1));
    markup.labels.push_back(fields[header.label]);
  }
  markup.positions.resize(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t n = 0; n < places.size(); ++n) {
    markup.positions.row(static_cast<Eigen::Index>(n)) = places[n];
  }
  if (!places.empty()) {
    to_lps(markup.positions, *header.frame);
  }
  return markup;
}

}  // namespace

Markup read_markup(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".json" && ending != ".fcsv") {
    fail(file, "a 3D Slicer markup (.mrk.json or .fcsv) is expected");
  }
  Markup markup = ending == ".json" ? read_json(file) : read_fcsv(file);
  if (markup.labels.empty()) {
    fail(file, "holds no point");
  }
  return markup;
}

}  // namespace brainshift::solve
