// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "segmentation/geometry/on_device.hpp"
#include "segmentation/geometry/points.hpp"

namespace brainshift::registration::device {

/// A node as a place looks at it: where it lies, how far its support reaches, mm, and its û, mm.
struct alignas(64) Node {
  double at[3], radius, value[3];
};

/// The nodes of about one octave of radius, in bins half the largest radius wide, those of a bin beside each other.
struct NodeLevel {
  double low[3], bin, largest_radius;
  std::int32_t size[3];  ///< in bins
  std::int32_t first;    ///< of its entries in NodeView::begin
};

/// Nodes where any place finds those that it sees.
struct NodeView {
  static constexpr int most_levels = 8;

  NodeLevel level[most_levels];
  int levels;
  const Node* node;
  const std::int32_t* begin;  ///< of each bin's nodes, x fastest; of each level one more than it has bins

  /// Calls use(node's number, distance, radius) for all nodes with distance < radius, the radii grown by a scale.
  template <class Use>
  BRAINSHIFT_ON_DEVICE void for_each_seen(const Eigen::Vector3d& x, double scale, const Use& use) const {
    for (int l = 0; l < levels; ++l) {
      for_each_seen_of(level[l], x, scale, use);
    }
  }

 private:
  struct Range {
    int first, last;
  };

  /// The bins along an axis that hold places within reach of x.
  BRAINSHIFT_ON_DEVICE static Range bins(const NodeLevel& of, int axis, double x, double reach) {
    const double last = of.size[axis] - 1.0, from = std::floor((x - reach - of.low[axis]) / of.bin),
                 to = std::floor((x + reach - of.low[axis]) / of.bin);
    // Beyond the level's box there are no bins: an empty range.
    return {static_cast<int>(from > 0 ? (from <= last ? from : last + 1) : 0),
            static_cast<int>(to < last ? (to >= 0 ? to : -1) : last)};
  }

  /// Distance along an axis from x to a bin.
  BRAINSHIFT_ON_DEVICE static double apart(const NodeLevel& of, int axis, double x, int bin) {
    const double low = of.low[axis] + bin * of.bin, high = low + of.bin;
    return x < low ? low - x : x > high ? x - high : 0;
  }

  template <class Use>
  BRAINSHIFT_ON_DEVICE void for_each_seen_of(const NodeLevel& of, const Eigen::Vector3d& x, double scale,
                                             const Use& use) const {
    constexpr double rounding = 1 + 1e-9;
    const double reach = rounding * scale * of.largest_radius;
    const Range zs = bins(of, 2, x[2], reach), ys = bins(of, 1, x[1], reach);
    for (int k = zs.first; k <= zs.last; ++k) {
      const double z = apart(of, 2, x[2], k);
      for (int j = ys.first; j <= ys.last; ++j) {
        const double y = apart(of, 1, x[1], j), left = reach * reach - z * z - y * y;
        if (left <= 0) {
          continue;
        }
        const Range xs = bins(of, 0, x[0], rounding * std::sqrt(left));
        const int row = of.first + of.size[0] * (j + of.size[1] * k);
        if (xs.first <= xs.last) {
          look_at(begin[row + xs.first], begin[row + xs.last + 1], x, scale, use);
        }
      }
    }
  }

  template <class Use>
  BRAINSHIFT_ON_DEVICE void look_at(int first, int last, const Eigen::Vector3d& x, double scale, const Use& use) const {
    for (int n = first; n < last; ++n) {
      const Node& a = node[n];
      const double dx = a.at[0] - x[0], dy = a.at[1] - x[1], dz = a.at[2] - x[2];
      const double squared = dx * dx + dy * dy + dz * dz, radius = scale * a.radius;
      constexpr double rounding = 1 + 1e-12;
      if (squared < rounding * radius * radius) {
        const double distance = std::sqrt(squared);
        if (distance < radius) {
          use(n, distance, radius);
        }
      }
    }
  }
};

/// What a NodeView looks into.
struct NodeBins {
  std::vector<Node> node;
  std::vector<std::int32_t> begin;
  std::vector<NodeLevel> level;
};

/// radius: of each node's support, mm, > 0; values: û, (n × 3).
NodeBins node_bins(const Points& positions, const std::vector<double>& radius, const Points& values);

/// Of bins whose arrays lie elsewhere.
NodeView view_of(const NodeBins& bins, const Node* node, const std::int32_t* begin);

}  // namespace brainshift::registration::device
