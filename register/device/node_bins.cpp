// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/device/node_bins.hpp"

#include <algorithm>
#include <map>

namespace brainshift::registration::device {

namespace {

constexpr double most_bins = 256;  // along an axis

/// The nodes of each octave of radius, those beyond the last level in it.
std::map<int, std::vector<Eigen::Index>> octaves(const std::vector<double>& radius) {
  const int smallest = std::ilogb(*std::min_element(radius.begin(), radius.end()));
  std::map<int, std::vector<Eigen::Index>> nodes;
  for (std::size_t a = 0; a < radius.size(); ++a) {
    nodes[std::min(std::ilogb(radius[a]) - smallest, NodeView::most_levels - 1)].push_back(
        static_cast<Eigen::Index>(a));
  }
  return nodes;
}

NodeLevel level_of(const Points& positions, const std::vector<double>& radius, const std::vector<Eigen::Index>& nodes) {
  NodeLevel level{};
  Eigen::RowVector3d low = positions.row(nodes.front()), high = low;
  for (const Eigen::Index a : nodes) {
    low = low.cwiseMin(positions.row(a));
    high = high.cwiseMax(positions.row(a));
    level.largest_radius = std::max(level.largest_radius, radius[static_cast<std::size_t>(a)]);
  }
  level.bin = std::max(0.5 * level.largest_radius, (high - low).maxCoeff() / most_bins);
  for (int axis = 0; axis < 3; ++axis) {
    level.low[axis] = low[axis];
    level.size[axis] = static_cast<std::int32_t>((high[axis] - low[axis]) / level.bin) + 1;
  }
  return level;
}

std::int32_t bin_of(const NodeLevel& level, const Eigen::RowVector3d& place) {
  std::int32_t bin[3];
  for (int axis = 0; axis < 3; ++axis) {
    bin[axis] = std::min(static_cast<std::int32_t>((place[axis] - level.low[axis]) / level.bin), level.size[axis] - 1);
  }
  return bin[0] + level.size[0] * (bin[1] + level.size[1] * bin[2]);
}

/// Adds the nodes of a level, by their bins, in a bin as they are numbered.
void append(const Points& positions, const std::vector<double>& radius, const Points& values, NodeLevel level,
            std::vector<Eigen::Index> nodes, NodeBins& bins) {
  std::stable_sort(nodes.begin(), nodes.end(), [&](Eigen::Index a, Eigen::Index b) {
    return bin_of(level, positions.row(a)) < bin_of(level, positions.row(b));
  });
  level.first = static_cast<std::int32_t>(bins.begin.size());
  const std::int32_t count = level.size[0] * level.size[1] * level.size[2];
  std::size_t next = 0;
  for (std::int32_t bin = 0; bin <= count; ++bin) {
    bins.begin.push_back(static_cast<std::int32_t>(bins.node.size()));
    for (; next < nodes.size() && bin_of(level, positions.row(nodes[next])) == bin; ++next) {
      const Eigen::Index a = nodes[next];
      bins.node.push_back({{positions(a, 0), positions(a, 1), positions(a, 2)},
                           radius[static_cast<std::size_t>(a)],
                           {values(a, 0), values(a, 1), values(a, 2)}});
    }
  }
  bins.level.push_back(level);
}

}  // namespace

NodeBins node_bins(const Points& positions, const std::vector<double>& radius, const Points& values) {
  NodeBins bins;
  bins.node.reserve(radius.size());
  for (auto& [octave, nodes] : octaves(radius)) {
    append(positions, radius, values, level_of(positions, radius, nodes), nodes, bins);
  }
  return bins;
}

NodeView view_of(const NodeBins& bins, const Node* node, const std::int32_t* begin) {
  NodeView view{};
  view.levels = static_cast<int>(bins.level.size());
  std::copy(bins.level.begin(), bins.level.end(), view.level);
  view.node = node;
  view.begin = begin;
  return view;
}

}  // namespace brainshift::registration::device
