// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "register/files/points_file.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read_json(const fs::path& file) {
  std::ifstream in(file);
  if (!in) {
    throw std::invalid_argument(file.string() + ": cannot be opened; check the path");
  }
  try {
    return Json::parse(in);
  } catch (const Json::exception& fault) {
    throw std::invalid_argument(file.string() + ": is no JSON file (" + fault.what() + "); save the markups again");
  }
}

/// 1 for LPS, -1 for RAS: what x and y are to be multiplied by.
double sign_of_frame(const fs::path& file, const Json& markup) {
  const std::string frame = markup.value("coordinateSystem", "LPS");
  if (frame != "LPS" && frame != "RAS") {
    throw std::invalid_argument(file.string() + ": the coordinate system must be LPS or RAS, found \"" + frame + "\"");
  }
  return frame == "LPS" ? 1 : -1;
}

struct Place {
  Json* position;
  double sign;
};

Eigen::RowVector3d read_position(const fs::path& file, std::size_t number, const Place& place) {
  Eigen::RowVector3d x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Json& p = *place.position;
    const bool a_number = p.is_array() && p.size() == 3 && p[axis].is_number();
    const double value = a_number ? p[axis].get<double>() : NAN;
    if (!std::isfinite(value)) {
      throw std::invalid_argument(file.string() + ": control point " + std::to_string(number + 1) +
                                  " must have a position of three finite numbers");
    }
    x[static_cast<Eigen::Index>(axis)] = axis < 2 ? place.sign * value : value;
  }
  return x;
}

std::vector<Place> places_in(const fs::path& file, Json& document) {
  std::vector<Place> places;
  for (Json& markup : document.at("markups")) {
    const double sign = sign_of_frame(file, markup);
    for (Json& point : markup.at("controlPoints")) {
      if (point.value("positionStatus", "defined") == "defined") {
        places.push_back({&point.at("position"), sign});
      }
    }
  }
  return places;
}

}  // namespace

void copy_markups(const fs::path& in, const fs::path& out, const MovePoints& move) {
  Json document = read_json(in);
  std::vector<Place> places;
  try {
    places = places_in(in, document);
  } catch (const Json::exception& fault) {
    throw std::invalid_argument(in.string() + ": is no 3D Slicer markups file (" + fault.what() + ")");
  }
  Points points(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t p = 0; p < places.size(); ++p) {
    points.row(static_cast<Eigen::Index>(p)) = read_position(in, p, places[p]);
  }
  const Points moved = move(points);
  for (std::size_t p = 0; p < places.size(); ++p) {
    const Eigen::RowVector3d x = moved.row(static_cast<Eigen::Index>(p));
    *places[p].position = {places[p].sign * x.x(), places[p].sign * x.y(), x.z()};
  }
  std::ofstream file(out);
  file << document.dump(2) << '\n';
  if (!file.flush()) {
    throw std::runtime_error(out.string() + ": could not be written whole; is the disk full or the folder read-only?");
  }
}

}  // namespace brainshift::registration
