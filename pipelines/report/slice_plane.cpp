// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/slice_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

// The eight voxels round a world position and their weights; nothing outside the outermost half voxel.
struct Cell {
  Eigen::Array3i base;
  Vector3d fraction;
};

std::optional<Cell> find_cell(const ImageGeometry& geometry, const Vector3d& world) {
  const Vector3d index = geometry.to_index(world);
  const Vector3d last = (geometry.size - 1).cast<double>().matrix();
  if (!((index.array() >= -0.5).all() && (index.array() <= last.array() + 0.5).all())) {
    return std::nullopt;
  }
  const Vector3d inside = index.cwiseMax(0.0).cwiseMin(last);
  const Eigen::Array3i base = inside.array().floor().cast<int>().min((geometry.size - 2).max(0));
  return Cell{base, inside - base.cast<double>().matrix()};
}

template <class Add>
void for_corners(const ImageGeometry& geometry, const Cell& cell, const Add& add) {
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3i bit(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const Eigen::Array3i voxel = (cell.base + bit).min(geometry.size - 1);
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) {
      weight *= bit[axis] == 1 ? cell.fraction[axis] : 1 - cell.fraction[axis];
    }
    add(geometry.offset(voxel.x(), voxel.y(), voxel.z()), weight);
  }
}

}  // namespace

std::array<SlicePlane, 3> anatomical_planes(const Vector3d& through, const Vector3d& low, const Vector3d& high,
                                            double scale) {
  return {make_plane("axial", 0, Vector3d::UnitY(), through, low, high, scale),
          make_plane("coronal", 0, -Vector3d::UnitZ(), through, low, high, scale),
          make_plane("sagittal", 1, -Vector3d::UnitZ(), through, low, high, scale)};
}

std::vector<CutSegment> cut_surface(const SlicePlane& plane, const Surface& surface) {
  const double level = plane.corner[plane.normal_axis];
  std::vector<CutSegment> segments;
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

std::vector<std::uint8_t> inside_mask(const SlicePlane& plane, const std::vector<CutSegment>& segments) {
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
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(plane.width) * static_cast<std::size_t>(plane.height));
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      const auto cell = find_cell(image.geometry, plane.world({x + 0.5, y + 0.5}));
      double value = cell ? 0 : std::numeric_limits<double>::quiet_NaN();
      if (cell) {
        for_corners(image.geometry, *cell,
                    [&](std::size_t offset, double weight) { value += weight * image.voxels[offset]; });
      }
      values.push_back(static_cast<float>(value));
    }
  }
  return values;
}

Vector3d sample_field(const VectorImage& field, const Vector3d& world) {
  Vector3d value = Vector3d::Zero();
  if (const auto cell = find_cell(field.geometry, world)) {
    for_corners(field.geometry, *cell, [&](std::size_t offset, double weight) {
      const auto& u = field.voxels[offset];
      value += weight * Vector3d(u[0], u[1], u[2]);
    });
  }
  return value;
}

}  // namespace brainshift::pipelines
