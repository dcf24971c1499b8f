// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "register/field/brain_zones.hpp"
#include "register/field/field_grid.hpp"
#include "segmentation/geometry/distance_grid.hpp"
#include "segmentation/geometry/on_device.hpp"

namespace brainshift::registration {

// How a voxel outside the brain gets its displacement, place by place: forward_field.hpp says why.

/// Of the nodes, mm.
inline double least_spacing(const std::vector<double>& spacing) {
  return *std::min_element(spacing.begin(), spacing.end());
}

/// How far outside the brain shape functions are trusted, mm; spacing: least_spacing() of their nodes, as nodes are
/// closest where displacements change most, under an opening.
inline double reach_of(double shell, double spacing) {
  constexpr double in_spacings = 0.3;
  return std::min(shell / 2, in_spacings * spacing);
}

/// How often the displacement outside is averaged: each sweep spreads it by the spacing / √3.
inline double smoothing_sweeps(const Eigen::Vector3d& spacing) {
  constexpr double width = 3.0;  // mm, standard deviation of the smoothing outside the brain
  return 3 * std::pow(width / spacing.maxCoeff(), 2);
}

/// Where the displacement of a voxel of the shell is taken: in its middle, or, farther out than `reach`, at the reach,
/// as shape functions extrapolate out there.
BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d place_in_shell(const DistanceGrid& outside, const Eigen::Vector3d& place,
                                                           double reach) {
  const double distance = outside.value(place);
  return distance > reach ? Eigen::Vector3d(place - (distance - reach) * outside.gradient(place)) : place;
}

/// The place near x that is `reach` away from the brain, by walking down the distance. One step suffices but where the
/// surface is hollow and its distance has a kink.
BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d place_at_reach(const DistanceGrid& outside, Eigen::Vector3d x,
                                                           double reach) {
  constexpr int most = 10;
  constexpr double close_enough = 0.05;  // mm
  for (int step = 0; step < most; ++step) {
    const double farther = outside.value(x) - reach;
    if (farther <= close_enough) {
      break;
    }
    x -= farther * outside.gradient(x);
  }
  return x;
}

/// What the mean over a voxel's neighbours is taken of.
struct Neighbourhood {
  Eigen::Array3i size;
  Eigen::Vector3d spacing;
  const Zone* zone;
  const std::array<float, 3>* field;
};

/// Mean of a voxel's six neighbours, those nearer to it counting more; neighbours beyond the fade do not count.
BRAINSHIFT_ON_DEVICE inline std::array<float, 3> mean_of_neighbours(const Neighbourhood& of,
                                                                    const Eigen::Array3i& place, std::size_t offset) {
  float sum[3] = {0, 0, 0};
  float total = 0;
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto weight = static_cast<float>(1 / (of.spacing[axis] * of.spacing[axis]));
    const auto add = [&](std::size_t neighbour) {
      if (of.zone[neighbour] != Zone::beyond) {
        const std::array<float, 3>& u = of.field[neighbour];
        total += weight;
        for (std::size_t c = 0; c < 3; ++c) {
          sum[c] += weight * u[c];
        }
      }
    };
    if (place[axis] > 0) {
      add(offset - stride);
    }
    if (place[axis] + 1 < of.size[axis]) {
      add(offset + stride);
    }
    stride *= static_cast<std::size_t>(of.size[axis]);
  }
  return total > 0 ? std::array<float, 3>{sum[0] / total, sum[1] / total, sum[2] / total} : of.field[offset];
}

/// Falls from 1 at 0 to 0 at 1, with zero slope at both ends and at most 1.25 between: the gentlest way out, as a
/// field that pushes outward by u folds where the ramp is steeper than 1/u.
BRAINSHIFT_ON_DEVICE inline double ramp(double t) {
  constexpr double bend = 0.2;  // the part of the way over which the slope grows, and again over which it falls
  const auto start = [](double s) { return s * s / (2 * bend * (1 - bend)); };
  if (t <= 0 || t >= 1) {
    return t <= 0 ? 1 : 0;
  }
  if (t < bend) {
    return 1 - start(t);
  }
  return t > 1 - bend ? start(1 - t) : 0.5 - (t - 0.5) / (1 - bend);
}

/// The displacement of a voxel outside, as smoothed, after the fade.
BRAINSHIFT_ON_DEVICE inline std::array<float, 3> faded(const std::array<float, 3>& u, double distance, double reach,
                                                       double fade) {
  return stored(ramp((distance - reach) / (fade - reach)) * Eigen::Vector3d(u[0], u[1], u[2]));
}

}  // namespace brainshift::registration
