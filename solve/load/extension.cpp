// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/extension.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace brainshift::solve {
namespace {

constexpr std::size_t points_used = 30;

std::vector<Eigen::Index> nearest(const PlanePoints& points, const Eigen::Vector2d& place) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  const Eigen::VectorXd squared = (points.rowwise() - place.transpose()).rowwise().squaredNorm();
  const std::size_t used = std::min(points_used, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(used), order.end(),
      [&](Eigen::Index a, Eigen::Index b) { return squared[a] < squared[b] || (squared[a] == squared[b] && a < b); });
  order.resize(used);
  return order;
}

/// r² log r
double thin_plate(double squared) {
  return squared > 0 ? 0.5 * squared * std::log(squared) : 0.0;
}

}  // namespace

Eigen::VectorXd extended(const PlanePoints& points, const Values& values, const Eigen::Vector2d& place) {
  const std::vector<Eigen::Index> used = nearest(points, place);
  const auto n = static_cast<Eigen::Index>(used.size());
  PlanePoints local = points(used, Eigen::all).rowwise() - place.transpose();
  const double scale = local.rowwise().norm().maxCoeff();
  if (scale > 0) {
    local /= scale;
  }
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + 3, values.cols());
  Eigen::VectorXd row = Eigen::VectorXd::Zero(n + 3);
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b < a; ++b) {
      system(a, b) = system(b, a) = thin_plate((local.row(a) - local.row(b)).squaredNorm());
    }
    system.row(a).tail<3>() << 1, local(a, 0), local(a, 1);
    row[a] = thin_plate(local.row(a).squaredNorm());
  }
  system.bottomRows<3>() = system.rightCols<3>().transpose();
  row[n] = 1;
  const Values known = values(used, Eigen::all);
  right.topRows(n) = known;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(n + 3, n + 3);
  decomposition.setThreshold(1e-10);
  const Eigen::VectorXd value = (row.transpose() * decomposition.compute(system).solve(right)).transpose();
  const Eigen::VectorXd least = known.colwise().minCoeff(), most = known.colwise().maxCoeff();
  const Eigen::VectorXd room = extension_overshoot * (most - least);
  return value.cwiseMax(least - room).cwiseMin(most + room);
}

}  // namespace brainshift::solve
