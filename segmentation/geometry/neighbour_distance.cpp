// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/neighbour_distance.hpp"

#include <algorithm>
#include <cmath>

#include "segmentation/geometry/point_tree.hpp"

namespace brainshift {

NearestNeighbours nearest_neighbours(const Points& points, int count) {
  const Eigen::Index rows = points.rows();
  NearestNeighbours result;
  result.count = static_cast<int>(std::clamp<Eigen::Index>(rows - 1, 0, count));
  const auto width = static_cast<std::size_t>(result.count);
  result.index.resize(static_cast<std::size_t>(rows) * width);
  result.distance.resize(result.index.size());
  if (width == 0) {
    return result;
  }
  constexpr Eigen::Index worth_threads = 2048;  // fewer take less than the time that threads stay awake afterwards
  const PointTree tree(points);
#pragma omp parallel if (rows >= worth_threads)
  {
    std::vector<std::size_t> found(width + 1);
    std::vector<double> squared(width + 1);
#pragma omp for schedule(static)
    for (Eigen::Index row = 0; row < rows; ++row) {
      tree.nearest(points.row(row).data(), width + 1, found.data(), squared.data());
      std::size_t written = 0;
      for (std::size_t k = 0; k <= width && written < width; ++k) {
        if (found[k] == static_cast<std::size_t>(row)) {
          continue;
        }
        const std::size_t slot = static_cast<std::size_t>(row) * width + written++;
        result.index[slot] = static_cast<std::int32_t>(found[k]);
        result.distance[slot] = std::sqrt(squared[k]);
      }
    }
  }
  return result;
}

std::vector<double> mean_neighbour_distance(const NearestNeighbours& neighbours, int count) {
  const int used = std::min(count, neighbours.count);
  if (used == 0) {
    return {};
  }
  const auto width = static_cast<std::size_t>(neighbours.count);
  std::vector<double> mean(neighbours.distance.size() / width);
  for (std::size_t row = 0; row < mean.size(); ++row) {
    double sum = 0;
    for (int k = 0; k < used; ++k) {
      sum += neighbours.distance[row * width + static_cast<std::size_t>(k)];
    }
    mean[row] = sum / used;
  }
  return mean;
}

}  // namespace brainshift
