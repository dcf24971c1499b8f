// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/nodal_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/image/voxels.hpp"

namespace brainshift::registration {

namespace {

constexpr double coarse_voxel = 4;  // mm; nodes are as far apart, and more

Points places_of_nodes(const Solution& solution, bool moved) {
  return moved ? Points(solution.positions + solution.displacement) : solution.positions;
}

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// The nodes in a tree, and what is known at them.
struct KnownNodes {
  Points places;
  std::vector<double> spacing;
  Eigen::MatrixXd values;
  PointTree tree{places};
};

/// The values of a point from which every node is farther away than its spacing and than `reach`, mm.
struct Outside {
  double value;
  double reach = 0;
};

Eigen::MatrixXd look_up(const KnownNodes& nodes, const Points& points, const Outside& outside) {
  constexpr std::size_t neighbours = 8;
  constexpr Eigen::Index many = 1000;  // threads for fewer cost more than they bring
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(points.rows(), nodes.values.cols());
#pragma omp parallel for schedule(static) if (points.rows() >= many)
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    std::array<std::size_t, neighbours> index{};
    std::array<double, neighbours> squared{};
    const auto found = nodes.tree.nearest(points.row(i).data(), neighbours, index.data(), squared.data());
    if (std::sqrt(squared[0]) > std::max(nodes.spacing[index[0]], outside.reach)) {
      result.row(i).setConstant(outside.value);
      continue;
    }
    double weights = 0;
    for (std::size_t n = 0; n < found; ++n) {
      const double weight = 1.0 / (squared[n] + 1e-12);
      result.row(i) += weight * nodes.values.row(static_cast<Eigen::Index>(index[n]));
      weights += weight;
    }
    result.row(i) /= weights;
  }
  return result;
}

}  // namespace

NodalLookUp nodal_look_up(const Solution& solution, Eigen::MatrixXd values, bool moved, double outside) {
  const std::shared_ptr<const KnownNodes> nodes(
      new KnownNodes{places_of_nodes(solution, moved), solution.spacing, std::move(values)});
  return [nodes, outside](const Points& points) { return look_up(*nodes, points, {outside}); };
}

Eigen::MatrixXd nodal_values_at(const Solution& solution, const Eigen::MatrixXd& values, bool moved,
                                const Points& points, double outside) {
  return nodal_look_up(solution, values, moved, outside)(points);
}

ScalarImage nodal_values_on(const Solution& solution, const std::vector<double>& values, bool moved,
                            const ImageGeometry& grid) {
  Points places(static_cast<Eigen::Index>(grid.voxel_count()), 3);
  for_each_voxel(grid.size, [&](int i, int j, int k) {
    places.row(static_cast<Eigen::Index>(grid.offset(i, j, k))) =
        grid.to_world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  });
  const KnownNodes nodes{places_of_nodes(solution, moved), solution.spacing, as_vector(values)};
  constexpr double diagonal = coarse_voxel * std::numbers::sqrt3;
  const Eigen::VectorXd at_voxels = look_up(nodes, places, {.value = 0, .reach = diagonal});
  return {grid, std::vector<float>(at_voxels.begin(), at_voxels.end())};
}

std::vector<double> estimated_error_at(const Solution& solution, const Points& points) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd values = nodal_values_at(solution, as_vector(solution.estimated_error), false, points, unknown);
  return {values.begin(), values.end()};
}

ImageGeometry grid_around_nodes(const Solution& solution, bool moved) {
  const Points nodes = places_of_nodes(solution, moved);
  const Eigen::Vector3d low = nodes.colwise().minCoeff();
  const Eigen::Vector3d high = nodes.colwise().maxCoeff();
  ImageGeometry grid;
  grid.spacing.setConstant(coarse_voxel);
  grid.origin = low.array() - coarse_voxel;
  grid.size = ((high - low) / coarse_voxel).array().ceil().cast<int>() + 3;
  return grid;
}

}  // namespace brainshift::registration
