// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/points_file.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "segmentation/files/frame.hpp"
#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/point_table.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/text_lines.hpp"
#include "segmentation/files/write_text.hpp"

namespace brainshift {

namespace {

using Json = nlohmann::ordered_json;

bool ends_with(const std::filesystem::path& file, std::string_view ending) {
  return in_lower_case(file.filename().string()).ends_with(ending);
}

/// A placed control point of a markups document.
struct ControlPoint {
  std::string position;  ///< JSON pointer
  Frame frame;
  std::size_t list;
};

struct Markups {
  Json document;
  std::vector<ControlPoint> points;
};

Json parse_markups(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  Json document = Json::parse(text, nullptr, false);
  if (document.is_discarded()) {
    refuse(file, "is no JSON; save the markups again");
  }
  return document;
}

const Json& list_in(const Json& object, const char* name, const std::filesystem::path& file) {
  if (!object.is_object() || !object.contains(name) || !object.at(name).is_array()) {
    refuse(file, "is no 3D Slicer markup: the list \"" + std::string(name) + "\" is missing");
  }
  return object.at(name);
}

Frame frame_of(const Json& markup, const std::filesystem::path& file) {
  if (!markup.contains("coordinateSystem")) {
    return Frame::lps;
  }
  const Json& system = markup.at("coordinateSystem");
  const auto frame = frame_named(system.is_string() ? system.get<std::string>() : system.dump());
  if (!frame) {
    refuse(file, "coordinateSystem must be LPS or RAS, found " + system.dump());
  }
  return *frame;
}

void check_units(const Json& markup, const std::filesystem::path& file) {
  if (!markup.contains("coordinateUnits")) {
    return;
  }
  const Json& units = markup.at("coordinateUnits");
  if (units != "mm" && !(units.is_array() && !units.empty() && units.front() == "mm")) {
    refuse(file, "coordinateUnits must be mm, found " + units.dump());
  }
}

std::string label_of(const Json& point) {
  const bool labelled = point.contains("label") && point.at("label").is_string();
  return labelled ? point.at("label").get<std::string>() : "";
}

Eigen::RowVector3d position_of(const Json& point, const std::string& which, const std::filesystem::path& file) {
  const Json none;
  const Json& position = point.contains("position") ? point.at("position") : none;
  Eigen::RowVector3d place = Eigen::RowVector3d::Constant(NAN);
  for (std::size_t axis = 0; position.is_array() && position.size() == 3 && axis < 3; ++axis) {
    place[static_cast<Eigen::Index>(axis)] = position[axis].is_number() ? position[axis].get<double>() : NAN;
  }
  if (!place.allFinite()) {
    refuse(file, which + " must have a position of three finite numbers, found " + position.dump());
  }
  return place;
}

/// 3D Slicer shows a point's description in its table.
void add_words(Json& point, const std::string& words) {
  const bool described = point.contains("description") && point.at("description").is_string();
  const std::string before = described ? point.at("description").get<std::string>() : "";
  point["description"] = before + (before.empty() ? "" : "; ") + words;
}

bool is_placed(const Json& point) {
  return !point.contains("positionStatus") || point.at("positionStatus") == "defined";
}

void write_json(const std::filesystem::path& out, const Json& document) {
  write_text(out, document.dump(2) + '\n');
}

}  // namespace

struct PointsFile::Content {
  std::variant<PointTable, Markups> as_read;
};

namespace {

/// Calls use(point, pointer to its position, frame, name for messages) for all control points.
template <class Use>
void for_each_control_point(const Json& document, const std::filesystem::path& file, const Use& use) {
  const Json& lists = list_in(document, "markups", file);
  for (std::size_t l = 0; l < lists.size(); ++l) {
    const Json& points = list_in(lists[l], "controlPoints", file);
    const Frame frame = frame_of(lists[l], file);
    check_units(lists[l], file);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const std::string which = "control point " + std::to_string(p + 1);
      if (!points[p].is_object()) {
        refuse(file, which + " is no object");
      }
      use(points[p],
          ControlPoint{"/markups/" + std::to_string(l) + "/controlPoints/" + std::to_string(p) + "/position", frame, l},
          which + " (\"" + label_of(points[p]) + "\")");
    }
  }
}

/// Where planes and boxes say a second time where they lie: the entries of x, y and z.
constexpr std::array<std::pair<const char*, std::array<std::size_t, 3>>, 3> second_places = {
    {{"center", {0, 1, 2}}, {"origin", {0, 1, 2}}, {"baseToNode", {3, 7, 11}}}};

/// Moves what a plane or box says of its place, in its frame, as the control point nearest to it, mostly the same
/// place.
void move_second_places(Json& list, const Points& before, const Points& after) {
  for (const auto& [name, entries] : second_places) {
    if (!list.contains(name) || !list.at(name).is_array() || list.at(name).size() <= entries[2]) {
      continue;
    }
    Json& numbers = list.at(name);
    Eigen::RowVector3d place = Eigen::RowVector3d::Constant(NAN);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Json& number = numbers[entries[static_cast<std::size_t>(axis)]];
      place[axis] = number.is_number() ? number.get<double>() : NAN;
    }
    Eigen::Index nearest = 0;
    (before.rowwise() - place).rowwise().squaredNorm().minCoeff(&nearest);
    for (Eigen::Index axis = 0; axis < 3 && place.allFinite(); ++axis) {
      numbers[entries[static_cast<std::size_t>(axis)]] = place[axis] + after(nearest, axis) - before(nearest, axis);
    }
  }
}

}  // namespace

PointsFile::PointsFile(const std::filesystem::path& file) {
  auto content = std::make_shared<Content>();
  if (ends_with(file, ".json")) {
    Markups markups{parse_markups(file), {}};
    std::vector<Eigen::RowVector3d> places;
    for_each_control_point(markups.document, file,
                           [&](const Json& point, const ControlPoint& control, const std::string& which) {
                             if (!is_placed(point)) {
                               not_placed_.push_back(which);
                               return;
                             }
                             Points place = position_of(point, which, file);
                             to_lps(place, control.frame);
                             places.emplace_back(place);
                             labels_.push_back(label_of(point));
                             markups.points.push_back(control);
                           });
    positions_ = as_points(places);
    lists_ = markups.document.at("markups").size();
    content->as_read = std::move(markups);
  } else if (ends_with(file, ".csv") || ends_with(file, ".fcsv")) {
    PointTable table = read_point_table(file);
    positions_ = vectors_in(table, "x", "y", "z");
    labels_ = table.find_column("label") ? texts_in(table, "label") : std::vector<std::string>(table.rows.size());
    content->as_read = std::move(table);
  } else {
    refuse(file, "a 3D Slicer markup (.mrk.json or .fcsv) or a table (.csv) is expected");
  }
  if (positions_.rows() == 0) {
    refuse(file, not_placed_.empty() ? "holds no point" : "holds no point that has been placed");
  }
  content_ = std::move(content);
}

void PointsFile::write_moved(const std::filesystem::path& out, const Points& places,
                             const std::vector<PointValues>& values) const {
  if (const auto* table = std::get_if<PointTable>(&content_->as_read)) {
    write_point_table(out, *table, places, values);
    return;
  }
  Markups markups = std::get<Markups>(content_->as_read);
  for (std::size_t begin = 0, end = 0; begin < markups.points.size(); begin = end) {
    const ControlPoint& first = markups.points[begin];
    for (end = begin; end < markups.points.size() && markups.points[end].list == first.list; ++end) {
    }
    const auto row = static_cast<Eigen::Index>(begin), rows = static_cast<Eigen::Index>(end - begin);
    Points before = positions_.middleRows(row, rows), after = places.middleRows(row, rows);
    to_lps(before, first.frame);
    to_lps(after, first.frame);
    move_second_places(markups.document["markups"][first.list], before, after);
  }
  for (std::size_t i = 0; i < markups.points.size(); ++i) {
    Points place = places.row(static_cast<Eigen::Index>(i));
    to_lps(place, markups.points[i].frame);  // the way there and back is the same
    const Json::json_pointer position(markups.points[i].position);
    markups.document[position] = {place(0, 0), place(0, 1), place(0, 2)};
    if (const std::string words = in_words(values, i); !words.empty()) {
      add_words(markups.document[position.parent_pointer()], words);
    }
  }
  write_json(out, markups.document);
}

bool is_points_file(const std::filesystem::path& file) {
  return ends_with(file, ".mrk.json") || ends_with(file, ".fcsv") || ends_with(file, ".csv");
}

}  // namespace brainshift
