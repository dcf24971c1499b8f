// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/estimated_error.hpp"

#include <array>
#include <cmath>

#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::registration {

namespace {

constexpr double error_voxel = 4;  // mm; nodes are as far apart, and more

Points places_of_nodes(const Solution& solution, bool moved) {
  return moved ? Points(solution.positions + solution.displacement) : solution.positions;
}

}  // namespace

std::vector<double> estimated_error_at(const Solution& solution, bool moved, const Points& points) {
  constexpr std::size_t neighbours = 8;
  const Points nodes = places_of_nodes(solution, moved);
  const PointTree tree(nodes);
  std::vector<double> result(static_cast<std::size_t>(points.rows()));
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    std::array<std::size_t, neighbours> index{};
    std::array<double, neighbours> squared{};
    const auto found = tree.nearest(points.row(i).data(), neighbours, index.data(), squared.data());
    if (std::sqrt(squared[0]) > solution.spacing[index[0]]) {
      continue;
    }
    double sum = 0, weights = 0;
    for (std::size_t n = 0; n < found; ++n) {
      const double weight = 1.0 / (squared[n] + 1e-12);
      sum += weight * solution.estimated_error[index[n]];
      weights += weight;
    }
    result[static_cast<std::size_t>(i)] = sum / weights;
  }
  return result;
}

ScalarImage estimated_error_image(const Solution& solution, bool moved) {
  const Points nodes = places_of_nodes(solution, moved);
  const Eigen::Vector3d low = nodes.colwise().minCoeff();
  const Eigen::Vector3d high = nodes.colwise().maxCoeff();
  ScalarImage image;
  image.geometry.spacing.setConstant(error_voxel);
  image.geometry.origin = low.array() - error_voxel;
  image.geometry.size = ((high - low) / error_voxel).array().ceil().cast<int>() + 3;
  Points places(static_cast<Eigen::Index>(image.geometry.voxel_count()), 3);
  for (int k = 0; k < image.geometry.size.z(); ++k) {
    for (int j = 0; j < image.geometry.size.y(); ++j) {
      for (int i = 0; i < image.geometry.size.x(); ++i) {
        places.row(static_cast<Eigen::Index>(image.geometry.offset(i, j, k))) =
            image.geometry.to_world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
      }
    }
  }
  const std::vector<double> error = estimated_error_at(solution, moved, places);
  image.voxels.assign(error.begin(), error.end());
  return image;
}

}  // namespace brainshift::registration
