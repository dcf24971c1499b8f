// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/keep_apart.hpp"

#include <algorithm>

#include "segmentation/geometry/neighbour_distance.hpp"

namespace brainshift::discretise {
namespace {

constexpr int neighbour_count = 6;

CloudDistances distances(const NearestNeighbours& neighbours, std::size_t nodes) {
  const auto width = static_cast<std::size_t>(neighbours.count);
  const std::vector<double> mean = mean_neighbour_distance(neighbours, neighbour_count);
  CloudDistances result{mean, std::vector<double>(nodes)};
  for (std::size_t node = 0; node < nodes; ++node) {
    for (std::size_t k = 0; k < width; ++k) {
      result.spacing[node] += mean[static_cast<std::size_t>(neighbours.index[node * width + k])];
    }
    result.spacing[node] /= static_cast<double>(width + 1);
    result.nearest[node] = neighbours.distance[node * width];
  }
  return result;
}

}  // namespace

CloudDistances cloud_distances(const Points& nodes) {
  return distances(nearest_neighbours(nodes, neighbour_count), static_cast<std::size_t>(nodes.rows()));
}

std::vector<char> keep_apart(const Points& nodes, std::size_t on_surface, double fraction) {
  const auto count = static_cast<std::size_t>(nodes.rows());
  const NearestNeighbours neighbours = nearest_neighbours(nodes, neighbour_count);
  const CloudDistances distance = distances(neighbours, count);
  const auto width = static_cast<std::size_t>(neighbours.count);
  std::vector<char> keep(count, 1);
  for (std::size_t node = 0; node < count; ++node) {
    if (keep[node] == 0 || distance.nearest[node] >= fraction * distance.spacing[node]) {
      continue;
    }
    const auto other = static_cast<std::size_t>(neighbours.index[node * width]);
    if (keep[other] != 0) {
      const bool node_goes = (node < on_surface) == (other < on_surface) ? node > other : node >= on_surface;
      keep[node_goes ? node : other] = 0;
    }
  }
  return keep;
}

}  // namespace brainshift::discretise
