// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_path.hpp"

#include <cmath>
#include <stdexcept>

#include "segmentation/files/number_table.hpp"
#include "solve/cut/self_crossing.hpp"

namespace brainshift::solve {
namespace {

/// A path as it was written.
struct WrittenPath {
  std::string name;
  std::string row;                                  ///< "line" or "point": what the numbers count
  std::vector<std::size_t> number;                  ///< one a vertex
  std::vector<std::pair<double, double>> vertices;  ///< mm
  std::vector<double> time;                         ///< one a vertex, or none

  [[noreturn]] void fail(std::size_t vertex, const std::string& what) const {
    const std::string place = row == "line" ? ":" : ", " + row + " ";  // of a file as FILE:LINE, as elsewhere
    throw std::invalid_argument(name + place + std::to_string(number[vertex]) + ": " + what);
  }
  std::string segment(std::size_t first) const {
    return row + "s " + std::to_string(number[first]) + " to " + std::to_string(number[first + 1]);
  }
};

void check_vertices(const WrittenPath& path) {
  if (path.vertices.size() < 2) {
    throw std::invalid_argument(path.name + ": holds " + std::to_string(path.vertices.size()) +
                                (path.vertices.size() == 1 ? " vertex" : " vertices") +
                                "; a cut's path takes at least two");
  }
  for (std::size_t i = 0; i < path.vertices.size(); ++i) {
    if (!std::isfinite(path.vertices[i].first) || !std::isfinite(path.vertices[i].second)) {
      path.fail(i, "the vertex is not finite");
    }
    if (i > 0 && path.vertices[i] == path.vertices[i - 1]) {
      path.fail(i, "the vertex repeats the one before; remove one of them");
    }
  }
  if (const auto meeting = meeting_segments(path.vertices)) {
    throw std::invalid_argument(path.name + ": the cut crosses or touches itself, in the segments of " +
                                path.segment(meeting->first) + " and " + path.segment(meeting->second) +
                                "; end it before, or make it two cuts");
  }
}

void check_times(const WrittenPath& path) {
  for (std::size_t i = 0; i < path.time.size(); ++i) {
    if (path.time[i] < 0) {
      path.fail(i, "the time is negative; the load's curve begins at 0");
    }
    if (i > 0 && path.time[i] < path.time[i - 1]) {
      path.fail(i, "the time is before that of the vertex before; vertices come in the order in which they are cut");
    }
  }
}

/// How far along the path each vertex is, mm.
std::vector<double> arc_length(const std::vector<std::pair<double, double>>& vertices) {
  std::vector<double> length(1, 0);
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    length.push_back(length.back() + std::hypot(vertices[i].first - vertices[i - 1].first,
                                                vertices[i].second - vertices[i - 1].second));
  }
  return length;
}

Cut checked_cut(const WrittenPath& path, const CutTiming& timing) {
  check_vertices(path);
  check_times(path);
  if (!timing.direction.isZero(0)) {
    throw std::invalid_argument(path.name +
                                ": a path is cut from its first vertex on; leave the direction out, or turn its "
                                "vertices round");
  }
  if (!path.time.empty()) {
    refuse_timing(timing, path.name);
  }
  Cut cut;
  cut.name = path.name;
  cut.time = path.time.empty() ? times_along(arc_length(path.vertices), timing, path.name) : path.time;
  cut.vertices.resize(static_cast<Eigen::Index>(path.vertices.size()), 3);
  for (std::size_t i = 0; i < path.vertices.size(); ++i) {
    cut.vertices.row(static_cast<Eigen::Index>(i)) << path.vertices[i].first, path.vertices[i].second, 0;
  }
  return cut;
}

}  // namespace

Cut read_cut_path(const std::filesystem::path& file, const CutTiming& timing) {
  NumberTable table = read_number_table(file, {"x,y", "x,y,time"});
  WrittenPath path{file.string(), "line", std::move(table.line), {}, {}};
  for (const std::vector<double>& row : table.rows) {
    path.vertices.emplace_back(row[0], row[1]);
    if (row.size() == 3) {
      path.time.push_back(row[2]);
    }
  }
  return checked_cut(path, timing);
}

Cut cut_path(const std::vector<std::pair<double, double>>& vertices, const CutTiming& timing, const std::string& name) {
  WrittenPath path{name, "point", {}, vertices, {}};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    path.number.push_back(i + 1);
  }
  return checked_cut(path, timing);
}

}  // namespace brainshift::solve
