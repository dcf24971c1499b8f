// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/signed_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "segmentation/geometry/pseudonormals.hpp"
#include "segmentation/geometry/triangle_distance.hpp"

namespace brainshift {
namespace {

constexpr double most_samples = 2e8;
constexpr std::int32_t none = -1;

struct Grid {
  double spacing;
  Eigen::Vector3d origin;
  Eigen::Array3i size;

  Eigen::Vector3d position(const Eigen::Array3i& index) const {
    return origin + spacing * index.cast<double>().matrix();
  }
  /// Samples from one to the next along an axis.
  std::ptrdiff_t stride(int axis) const { return size.head(axis).cast<std::ptrdiff_t>().prod(); }
  std::ptrdiff_t offset(const Eigen::Array3i& index) const {
    return index.x() + std::ptrdiff_t{size.x()} * (index.y() + std::ptrdiff_t{size.y()} * index.z());
  }
  std::size_t count() const { return static_cast<std::size_t>(stride(3)); }
};

/// Per sample: the nearest triangle known so far and the squared distance to it.
struct Nearest {
  std::vector<std::int32_t> triangle;
  std::vector<double> squared;

  void offer(std::ptrdiff_t sample, std::int32_t candidate, double distance_squared) {
    if (distance_squared < squared[sample]) {
      squared[sample] = distance_squared;
      triangle[sample] = candidate;
    }
  }
};

struct Sweep {
  int along, across;  ///< axes
  bool forward;
};

double squared_distance(const TriangleFrame& triangle, const Eigen::Vector3d& p) {
  return (nearest_on_triangle(triangle, p).point - p).squaredNorm();
}

Grid grid_around(const Surface& surface, const SignedDistanceOptions& options) {
  if (!(options.spacing > 0) || !(options.margin >= 0) || !std::isfinite(options.spacing + options.margin)) {
    throw std::invalid_argument("signed distance: the grid's spacing must be positive and its margin not negative");
  }
  const Eigen::Vector3d low = surface.vertices.colwise().minCoeff().transpose().array() - options.margin;
  const Eigen::Vector3d high = surface.vertices.colwise().maxCoeff().transpose().array() + options.margin;
  const Eigen::Array3d steps = ((high - low) / options.spacing).array().ceil().max(1.0);
  if (!((steps + 1).prod() <= most_samples)) {
    throw std::invalid_argument("signed distance: a grid of " + std::to_string(options.spacing) +
                                " mm over a surface that is " + std::to_string((high - low).maxCoeff()) +
                                " mm wide is too large; are the surface's coordinates in millimetres?");
  }
  return {options.spacing, low, steps.cast<int>() + 1};
}

std::vector<TriangleFrame> triangle_frames(const Surface& surface) {
  std::vector<TriangleFrame> frames(static_cast<std::size_t>(surface.triangles.rows()));
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const auto corner = surface.triangles.row(t);
    const Eigen::Vector3d a = surface.vertices.row(corner[0]);
    frames[t] = {a, surface.vertices.row(corner[1]).transpose() - a, surface.vertices.row(corner[2]).transpose() - a};
  }
  return frames;
}

/// A flat triangle adds nothing: its edges are those of its neighbours too.
bool is_flat(const TriangleFrame& t) {
  const double longest = std::max(t.ab.squaredNorm(), t.ac.squaredNorm());
  return !(t.ab.cross(t.ac).squaredNorm() > 1e-24 * longest * longest);
}

struct IndexBox {
  Eigen::Array3i low, high;  ///< both included
};

IndexBox samples_near(const TriangleFrame& t, const Grid& grid, double band) {
  const Eigen::Array3d low = t.a.array() + t.ab.array().min(t.ac.array()).min(0.0) - band;
  const Eigen::Array3d high = t.a.array() + t.ab.array().max(t.ac.array()).max(0.0) + band;
  const Eigen::Array3d first = ((low - grid.origin.array()) / grid.spacing).ceil();
  const Eigen::Array3d last = ((high - grid.origin.array()) / grid.spacing).floor();
  return {first.cast<int>().max(0), last.cast<int>().min(grid.size - 1)};
}

/// Exact distances of all samples nearer to the surface than the band; upper bounds at some others. Each thread fills
/// whole layers and meets the triangles in their order, so that the number of threads changes nothing.
Nearest nearest_in_band(const std::vector<TriangleFrame>& frames, const Grid& grid, double band) {
  Nearest nearest{std::vector<std::int32_t>(grid.count(), none),
                  std::vector<double>(grid.count(), std::numeric_limits<double>::infinity())};
  std::vector<IndexBox> boxes(frames.size());
  std::vector<std::vector<std::int32_t>> in_layer(static_cast<std::size_t>(grid.size.z()));
  for (std::size_t t = 0; t < frames.size(); ++t) {
    if (is_flat(frames[t])) {
      continue;
    }
    boxes[t] = samples_near(frames[t], grid, band);
    for (int k = boxes[t].low.z(); k <= boxes[t].high.z(); ++k) {
      in_layer[k].push_back(static_cast<std::int32_t>(t));
    }
  }
#pragma omp parallel for schedule(dynamic, 1)
  for (int k = 0; k < grid.size.z(); ++k) {
    for (const std::int32_t t : in_layer[k]) {
      const TriangleFrame& frame = frames[t];
      const IndexBox& box = boxes[t];
      for (int j = box.low.y(); j <= box.high.y(); ++j) {
        for (int i = box.low.x(); i <= box.high.x(); ++i) {
          nearest.offer(grid.offset({i, j, k}), t, squared_distance(frame, grid.position({i, j, k})));
        }
      }
    }
  }
  return nearest;
}

/// Hands the nearest triangles on along one axis, each sample taking them from the three before it in a slice of that
/// axis and another. Slices are independent of one another, so that threads need not wait and their number changes
/// nothing.
void sweep(const std::vector<TriangleFrame>& frames, const Grid& grid, double band, const Sweep& way,
           Nearest& nearest) {
  const int slice_axis = 3 - way.along - way.across;
  const std::ptrdiff_t back = way.forward ? -grid.stride(way.along) : grid.stride(way.along);
  const std::ptrdiff_t side = grid.stride(way.across);
  const auto fill = [&](const Eigen::Array3i& index) {
    const std::ptrdiff_t sample = grid.offset(index);
    if (nearest.squared[sample] <= band * band) {
      return;
    }
    const Eigen::Vector3d p = grid.position(index);
    const std::ptrdiff_t low = index[way.across] > 0 ? -side : 0;
    const std::ptrdiff_t high = index[way.across] < grid.size[way.across] - 1 ? side : 0;
    std::int32_t tried = nearest.triangle[sample];
    for (const std::ptrdiff_t beside : {std::ptrdiff_t{0}, low, high}) {
      const std::int32_t candidate = nearest.triangle[sample + back + beside];
      if (candidate != none && candidate != tried) {
        nearest.offer(sample, candidate, squared_distance(frames[candidate], p));
        tried = candidate;
      }
    }
  };
  const int steps = grid.size[way.along];
#pragma omp parallel for schedule(dynamic, 1)
  for (int slice = 0; slice < grid.size[slice_axis]; ++slice) {
    Eigen::Array3i index;
    index[slice_axis] = slice;
    for (int step = 1; step < steps; ++step) {
      index[way.along] = way.forward ? step : steps - 1 - step;
      for (index[way.across] = 0; index[way.across] < grid.size[way.across]; ++index[way.across]) {
        fill(index);
      }
    }
  }
}

/// Signs: within the band by the normal of the nearest part; elsewhere that of the sample before in the row, as no
/// step between samples outside the band crosses the surface. A row starts outside, or within the band.
std::vector<float> signed_samples(const std::vector<TriangleFrame>& frames, const Pseudonormals& normals,
                                  const Grid& grid, double band, double farthest, const Nearest& nearest) {
  std::vector<float> samples(grid.count());
#pragma omp parallel for schedule(dynamic, 1)
  for (int k = 0; k < grid.size.z(); ++k) {
    for (int j = 0; j < grid.size.y(); ++j) {
      double sign = 1;
      for (int i = 0; i < grid.size.x(); ++i) {
        const std::ptrdiff_t sample = grid.offset({i, j, k});
        const double squared = nearest.squared[sample];
        if (squared <= band * band) {
          const Eigen::Vector3d p = grid.position({i, j, k});
          const std::int32_t t = nearest.triangle[sample];
          const NearestOnTriangle on = nearest_on_triangle(frames[t], p);
          sign = (p - on.point).dot(normals.of(t, on.part)) < 0 ? -1 : 1;
        }
        samples[sample] = static_cast<float>(sign * std::min(farthest, std::sqrt(squared)));
      }
    }
  }
  return samples;
}

}  // namespace

SignedDistance::SignedDistance(const Surface& surface, const SignedDistanceOptions& options) {
  const Pseudonormals normals = pseudonormals(surface);
  const Grid grid = grid_around(surface, options);
  const std::vector<TriangleFrame> frames = triangle_frames(surface);
  const double band = options.band();
  Nearest nearest = nearest_in_band(frames, grid, band);
  for (int along = 2; along >= 0 && options.far; --along) {
    for (const int across : {(along + 1) % 3, (along + 2) % 3}) {
      sweep(frames, grid, band, {along, across, true}, nearest);
      sweep(frames, grid, band, {along, across, false}, nearest);
    }
  }
  const double horizon = options.far ? std::numeric_limits<double>::infinity() : band;
  samples_ = {.spacing = grid.spacing,
              .horizon = horizon,
              .origin = grid.origin,
              .size = grid.size,
              .value = signed_samples(frames, normals, grid, band, horizon, nearest)};
}

void SignedDistance::fetch(const Eigen::Vector3d& position) const {
  const DistanceGrid of = grid();
  const Eigen::Array3d index = of.index_of(position);
  if (!of.is_inner(index)) {
    return;
  }
  const Eigen::Array<std::ptrdiff_t, 3, 1> low = (index - 0.5).cast<std::ptrdiff_t>();
  const std::ptrdiff_t row = samples_.size[0], plane = row * samples_.size[1];
  const float* const first = samples_.value.data() + low[0] + low[1] * row + low[2] * plane;
  for (int z = 0; z < 3; ++z) {
    for (int y = 0; y < 3; ++y) {
      __builtin_prefetch(first + 1 + y * row + z * plane);  // of three in a row, nearly always on one cache line
    }
  }
}

}  // namespace brainshift
