// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_facets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "segmentation/geometry/same_places.hpp"
#include "solve/cut/cut_fronts.hpp"

namespace brainshift::solve {

namespace {

constexpr std::int32_t none = -1;

/// Where the tip of a path is at a time, as the number of its vertex and a share of the way to the next; negative
/// before it has begun.
double tip_at(const Cut& path, double time) {
  if (path.time.empty()) {
    return time < 0 ? -1 : static_cast<double>(path.vertices.rows() - 1);
  }
  const auto next =
      static_cast<std::size_t>(std::upper_bound(path.time.begin(), path.time.end(), time) - path.time.begin());
  if (next == 0 || next == path.time.size()) {
    return static_cast<double>(next) - 1;
  }
  return static_cast<double>(next) - 1 + (time - path.time[next - 1]) / (path.time[next] - path.time[next - 1]);
}

/// The corners of a path between two places of its tip.
std::vector<Eigen::Vector3d> passed(const Cut& path, double from, double to) {
  std::vector<Eigen::Vector3d> corners;
  const auto place = [&](double at) -> Eigen::Vector3d {
    const auto i = std::min(static_cast<Eigen::Index>(at), path.vertices.rows() - 2);
    return path.vertices.row(i) + (at - static_cast<double>(i)) * (path.vertices.row(i + 1) - path.vertices.row(i));
  };
  from = std::max(from, 0.0);
  if (to <= from) {
    return corners;
  }
  corners.push_back(place(from));
  for (double i = std::floor(from) + 1; i < to; ++i) {
    corners.push_back(place(i));
  }
  corners.push_back(place(to));
  return corners;
}

/// The vertex there, a new one where there is none: a tear hangs together with the cut from which it starts.
std::int32_t vertex_at(const Eigen::Vector3d& x, CutFacets& cut) {
  for (Eigen::Index v = 0; v < cut.vertices.rows(); ++v) {
    if (cut.vertices.row(v) == x.transpose()) {
      return static_cast<std::int32_t>(v);
    }
  }
  cut.vertices.conservativeResize(cut.vertices.rows() + 1, 3);
  cut.vertices.bottomRows(1) = x.transpose();
  return static_cast<std::int32_t>(cut.vertices.rows()) - 1;
}

void append(const std::vector<Eigen::Vector3d>& corners, CutFacets& out) {
  if (corners.size() < 2) {
    return;
  }
  std::int32_t before = none;
  for (const Eigen::Vector3d& corner : corners) {
    const std::int32_t vertex = vertex_at(corner, out);
    if (before != none) {
      out.facets.conservativeResize(out.facets.rows() + 1, 3);
      out.facets.bottomRows(1) << before, vertex, none;
    }
    before = vertex;
  }
}

/// When a triangle is cut: at the mean of its corners.
double time_of(const Cut& sheet, Eigen::Index triangle) {
  double mean = 0;
  for (const std::int32_t v : sheet.triangles.row(triangle)) {
    mean += sheet.time.empty() ? 0 : sheet.time[static_cast<std::size_t>(v)] / 3;
  }
  return mean;
}

void append_sheet(const Cut& sheet, double after, double until, CutFacets& out) {
  const auto first = static_cast<std::int32_t>(out.vertices.rows());
  std::vector<Eigen::Index> active;
  for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
    const double time = time_of(sheet, t);
    if (time > after && time <= until) {
      active.push_back(t);
    }
  }
  out.vertices.conservativeResize(first + sheet.vertices.rows(), 3);
  out.vertices.bottomRows(sheet.vertices.rows()) = sheet.vertices;
  const Eigen::Index facets = out.facets.rows();
  out.facets.conservativeResize(facets + static_cast<Eigen::Index>(active.size()), 3);
  for (std::size_t i = 0; i < active.size(); ++i) {
    out.facets.row(facets + static_cast<Eigen::Index>(i)) = sheet.triangles.row(active[i]).array() + first;
  }
}

/// When the tip has come a stride further.
std::vector<double> path_times(const Cut& path, double stride) {
  std::vector<double> times;
  double along = 0, next = stride;
  for (Eigen::Index i = 1; i < path.vertices.rows(); ++i) {
    const double length = (path.vertices.row(i) - path.vertices.row(i - 1)).norm();
    const double start = path.time[static_cast<std::size_t>(i) - 1], end = path.time[static_cast<std::size_t>(i)];
    for (; next < along + length; next += stride) {
      times.push_back(start + (next - along) / length * (end - start));
    }
    along += length;
  }
  times.push_back(path.time.back());
  return times;
}

/// When the front, taken to be as long as the side of a square like the sheet, has come a stride further.
std::vector<double> sheet_times(const Cut& sheet, double stride) {
  const Surface whole{sheet.vertices, sheet.triangles};
  const double share = stride * std::sqrt(area(whole));
  std::vector<std::pair<double, double>> areas;  // by time
  for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
    areas.emplace_back(time_of(sheet, t), triangle(whole, t).area_vector().norm());
  }
  std::sort(areas.begin(), areas.end());
  std::vector<double> times;
  double since = 0;
  for (const auto& [time, more] : areas) {
    since += more;
    if (since >= share) {
      times.push_back(time);
      since = 0;
    }
  }
  times.push_back(areas.back().first);
  return times;
}

}  // namespace

CutFacets facets_between(std::span<const Cut> cuts, double after, double until) {
  CutFacets cut;
  for (const Cut& c : cuts) {
    cut.planar = c.is_path();
    if (c.is_path()) {
      append(passed(c, tip_at(c, after), tip_at(c, until)), cut);
    } else {
      append_sheet(c, after, until, cut);
    }
  }
  if (!cut.planar) {
    join_at_same_places(cut.vertices, cut.facets);
  }
  return cut;
}

CutFacets facets_at(std::span<const Cut> cuts, double time, const InsideBody& inside, double spacing) {
  CutFacets cut = facets_between(cuts, from_the_start, time);
  if (!cut.planar) {
    split_long_rims(spacing, inside, cut);
  }
  find_fronts(inside, spacing, cut);
  return cut;
}

CutFacets joined(const CutFacets& first, CutFacets second) {
  if (first.empty()) {
    return second;
  }
  CutFacets both = first;
  const auto shift = static_cast<std::int32_t>(first.vertices.rows());
  both.vertices.conservativeResize(shift + second.vertices.rows(), 3);
  both.vertices.bottomRows(second.vertices.rows()) = second.vertices;
  both.facets.conservativeResize(first.facets.rows() + second.facets.rows(), 3);
  both.facets.bottomRows(second.facets.rows()) = second.facets.array() + shift;
  for (const auto& [from, to] : second.front) {
    both.front.push_back({from + shift, to + shift});
  }
  return both;
}

double last_time(std::span<const Cut> cuts) {
  double last = 0;
  for (const Cut& c : cuts) {
    last = c.time.empty() ? last : std::max(last, *std::max_element(c.time.begin(), c.time.end()));
  }
  return last;
}

std::vector<double> times_of_advance(std::span<const Cut> cuts, double stride) {
  std::vector<double> times;
  for (const Cut& c : cuts) {
    const std::vector<double> own = c.time.empty() ? std::vector<double>()
                                    : c.is_path()  ? path_times(c, stride)
                                                   : sheet_times(c, stride);
    times.insert(times.end(), own.begin(), own.end());
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

double extent(const CutFacets& cut) {
  double sum = 0;
  for (const auto& f : cut.facets.rowwise()) {
    const Eigen::Vector3d a = cut.vertices.row(f[0]), along = Eigen::Vector3d(cut.vertices.row(f[1])) - a;
    sum += cut.planar ? along.norm() : along.cross(Eigen::Vector3d(cut.vertices.row(f[2])) - a).norm() / 2;
  }
  return sum;
}

}  // namespace brainshift::solve
