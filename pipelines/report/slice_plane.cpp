// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/slice_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "segmentation/geometry/grid_cell.hpp"

namespace brainshift::pipelines {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

SlicePlane make_plane(const std::string& name, int right_axis, const Vector3d& down, const Vector3d& through,
                      const Vector3d& low, const Vector3d& high, double scale) {
  SlicePlane plane;
  plane.name = name;
  plane.right = Vector3d::Unit(right_axis);
  plane.down = down;
  plane.scale = scale;
  const bool downwards_is_plus = down.sum() > 0;
  const int down_axis = downwards_is_plus ? 1 : 2;
  plane.normal_axis = 3 - right_axis - down_axis;
  plane.corner[plane.normal_axis] = through[plane.normal_axis];
  plane.corner[right_axis] = low[right_axis];
  plane.corner[down_axis] = downwards_is_plus ? low[down_axis] : high[down_axis];
  plane.width = static_cast<int>(std::ceil(scale * (high - low)[right_axis]));
  plane.height = static_cast<int>(std::ceil(scale * (high - low)[down_axis]));
  const bool shows_sides = right_axis == 0;
  plane.letters = {shows_sides ? 'R' : 'A', shows_sides ? 'L' : 'P', downwards_is_plus ? 'A' : 'S',
                   downwards_is_plus ? 'P' : 'I'};
  return plane;
}

}  // namespace

std::array<SlicePlane, 3> anatomical_planes(const Vector3d& through, const Vector3d& low, const Vector3d& high,
                                            double scale) {
  return {make_plane("axial", 0, Vector3d::UnitY(), through, low, high, scale),
          make_plane("coronal", 0, -Vector3d::UnitZ(), through, low, high, scale),
          make_plane("sagittal", 1, -Vector3d::UnitZ(), through, low, high, scale)};
}

std::vector<Segment> cut_surface(const SlicePlane& plane, const Surface& surface) {
  const double level = plane.corner[plane.normal_axis];
  std::vector<Segment> segments;
  for (const auto& triangle : surface.triangles.rowwise()) {
    Vector2d crossing[3];
    int count = 0;
    for (int edge = 0; edge < 3; ++edge) {
      const Vector3d a = surface.vertices.row(triangle[edge]);
      const Vector3d b = surface.vertices.row(triangle[(edge + 1) % 3]);
      const double from = a[plane.normal_axis] - level;
      const double to = b[plane.normal_axis] - level;
      if ((from < 0) != (to < 0)) {
        crossing[count++] = plane.pixel(a + (b - a) * (from / (from - to)));
      }
    }
    if (count == 2) {
      segments.push_back({crossing[0], crossing[1]});
    }
  }
  return segments;
}

std::vector<std::uint8_t> inside_mask(const SlicePlane& plane, const std::vector<Segment>& segments) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(plane.height));
  for (const auto& segment : segments) {
    const auto& [upper, lower] = std::minmax(segment.from, segment.to, [](auto& a, auto& b) { return a.y() < b.y(); });
    const int first = std::max(0, static_cast<int>(std::ceil(upper.y() - 0.5)));
    for (int row = first; row < plane.height && row + 0.5 < lower.y(); ++row) {
      const double t = (row + 0.5 - upper.y()) / (lower.y() - upper.y());
      crossings[static_cast<std::size_t>(row)].push_back(upper.x() + t * (lower.x() - upper.x()));
    }
  }
  std::vector<std::uint8_t> mask;
  mask.reserve(static_cast<std::size_t>(plane.width) * crossings.size());
  for (auto& row : crossings) {
    std::ranges::sort(row);
    for (int x = 0; x < plane.width; ++x) {
      const auto passed = std::ranges::lower_bound(row, x + 0.5) - row.begin();
      mask.push_back(static_cast<std::uint8_t>(passed % 2));
    }
  }
  return mask;
}

std::vector<float> sample_slice(const SlicePlane& plane, const ScalarImage& image) {
  const Eigen::Array3d high = image.geometry.size.cast<double>() - 0.5;
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(plane.width) * static_cast<std::size_t>(plane.height));
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      const Vector3d index = image.geometry.to_index(plane.world({x + 0.5, y + 0.5}));
      if ((index.array() < -0.5).any() || (index.array() > high).any()) {
        values.push_back(std::numeric_limits<float>::quiet_NaN());
        continue;
      }
      const GridCell cell(image.geometry.size, index);
      values.push_back(
          static_cast<float>(cell.interpolate([&image](std::size_t offset) { return image.voxels[offset]; })));
    }
  }
  return values;
}

}  // namespace brainshift::pipelines
