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

Vector3d centre_of(const SlicePlane& plane, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(plane.width);
  return plane.world({static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5});
}

std::vector<std::size_t> pixels_inside(const SlicePlane& plane, const discretise::Scanlines& body) {
  std::vector<std::size_t> inside;
  for (std::size_t pixel = 0; pixel < plane.pixel_count(); ++pixel) {
    if (body.inside(centre_of(plane, pixel))) {
      inside.push_back(pixel);
    }
  }
  return inside;
}

std::vector<float> sample_slice(const SlicePlane& plane, const ScalarImage& image) {
  const Eigen::Array3d high = image.geometry.size.cast<double>() - 0.5;
  std::vector<float> values(plane.pixel_count(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t pixel = 0; pixel < values.size(); ++pixel) {
    const Eigen::Array3d index = image.geometry.to_index(centre_of(plane, pixel));
    if ((index >= -0.5).all() && (index <= high).all()) {
      const GridCell cell(image.geometry.size, index);
      values[pixel] =
          static_cast<float>(cell.interpolate([&image](std::size_t offset) { return image.voxels[offset]; }));
    }
  }
  return values;
}

}  // namespace brainshift::pipelines
