// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_distance.hpp"

#include <cmath>

namespace brainshift::solve {

namespace {

/// Of the samples along an axis.
struct GridAxis {
  double origin;
  std::int32_t size, stride;
};

/// As GridCell::interpolate(), and the distance to the grid from outside.
BRAINSHIFT_CLONES
void interpolate_each(const float* samples, const GridAxis (&axes)[3], double spacing,
                      const VectorOfEach<double>& place, NumberOfEach<double>& distance) {
  double share[3][members], beyond[members] = {}, sum[members] = {};
  std::int32_t base[members] = {};
  const double per_spacing = 1 / spacing;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = axes[axis].size - 1, highest = axes[axis].size > 1 ? last - 1 : 0;
    for (std::size_t m = 0; m < members; ++m) {
      const double wanted = (place.of[axis][m] - axes[axis].origin) * per_spacing;
      const double above = wanted > 0 ? wanted : 0;  // this order turns NaN into 0
      const double inside = above < last ? above : last;
      const double cell = inside < highest ? inside : highest;
      const auto low = static_cast<std::int32_t>(cell);
      base[m] += low * axes[axis].stride;
      share[axis][m] = inside - low;
      beyond[m] += (wanted - inside) * (wanted - inside);
    }
  }
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::int32_t offset = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      offset += (corner >> axis & 1) != 0 && axes[axis].size > 1 ? axes[axis].stride : 0;
    }
    float value[members];
    for (std::size_t m = 0; m < members; ++m) {
      value[m] = samples[base[m] + offset];
    }
    for (std::size_t m = 0; m < members; ++m) {
      const double x = (corner & 1) != 0 ? share[0][m] : 1 - share[0][m];
      const double y = (corner & 2) != 0 ? share[1][m] : 1 - share[1][m];
      const double z = (corner & 4) != 0 ? share[2][m] : 1 - share[2][m];
      sum[m] += x * y * z * static_cast<double>(value[m]);
    }
  }
  for (std::size_t m = 0; m < members; ++m) {
    distance.of[m] = sum[m] + spacing * __builtin_sqrt(beyond[m]);
  }
}

}  // namespace

NumberOfEach<double> distance_of_each(const SignedDistance& distance, const VectorOfEach<double>& place) {
  const SignedDistance::Samples& samples = distance.samples();
  const Eigen::Array3i& size = samples.size;
  const GridAxis axes[3] = {{samples.origin[0], size[0], 1},
                            {samples.origin[1], size[1], size[0]},
                            {samples.origin[2], size[2], size[0] * size[1]}};
  NumberOfEach<double> result;
  interpolate_each(samples.value.data(), axes, samples.spacing, place, result);
  return result;
}

VectorOfEach<double> gradient_of_each(const SignedDistance& distance, const VectorOfEach<double>& place) {
  const double spacing = distance.samples().spacing;
  VectorOfEach<double> gradient;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    VectorOfEach<double> ahead = place, behind = place;
    numbers(ahead.of[axis]) += spacing / 2;
    numbers(behind.of[axis]) -= spacing / 2;
    numbers(gradient.of[axis]) =
        numbers(distance_of_each(distance, ahead).of) - numbers(distance_of_each(distance, behind).of);
  }
  constexpr double rounding = 1e-6;  // over the spacing; beyond the horizon there is no direction
  const Numbers norm = dot(gradient, gradient).sqrt();
  const Numbers scale = (norm > rounding * spacing).select(1 / norm, 0.0);
  for (auto& axis : gradient.of) {
    numbers(axis) *= scale;
  }
  return gradient;
}

}  // namespace brainshift::solve
