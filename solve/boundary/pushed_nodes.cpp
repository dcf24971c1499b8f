// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/pushed_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace brainshift::solve {

PushedNodes::PushedNodes(const Points& positions, std::span<const std::int32_t> nodes, const ShapeRows& rows)
    : positions_(static_cast<Eigen::Index>(nodes.size()), 3),
      begin_{0},
      inverse_row_sum_(nodes.size(), 0.0),
      push_(3 * nodes.size()),
      total_(3 * nodes.size()) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const ShapeRow row = rows[static_cast<std::size_t>(nodes[i])];
    node_.insert(node_.end(), row.node.begin(), row.node.end());
    shape_.insert(shape_.end(), row.value.begin(), row.value.end());
    begin_.push_back(static_cast<std::int64_t>(node_.size()));
    positions_.row(static_cast<Eigen::Index>(i)) = positions.row(nodes[i]);
  }
}

void PushedNodes::weigh(std::span<const double> mass) {
  inverse_mass_.resize(mass.size());
  std::transform(mass.begin(), mass.end(), inverse_mass_.begin(), [](double m) { return 1 / m; });
  std::vector<double> column_sum(mass.size(), 0.0);
  for (std::size_t k = 0; k < node_.size(); ++k) {
    column_sum[static_cast<std::size_t>(node_[k])] += std::abs(shape_[k]);
  }
  for (std::size_t i = 0; i < size(); ++i) {
    double sum = 0;
    for (std::int64_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      const auto pair = static_cast<std::size_t>(k);
      const auto node = static_cast<std::size_t>(node_[pair]);
      sum += std::abs(shape_[pair]) * inverse_mass_[node] * column_sum[node];
    }
    inverse_row_sum_[i] = 1 / sum;
  }
}

Eigen::Vector3d PushedNodes::place(std::size_t i, const NodalVectors& parameters) const {
  Eigen::Vector3d x = positions_.row(static_cast<Eigen::Index>(i));
  for (std::int64_t k = begin_[i]; k < begin_[i + 1]; ++k) {
    const auto pair = static_cast<std::size_t>(k);
    x += shape_[pair] * Eigen::Map<const Eigen::Vector3d>(&parameters[4 * static_cast<std::size_t>(node_[pair])]);
  }
  return x;
}

void PushedNodes::begin() {
  std::fill(total_.begin(), total_.end(), 0.0);
}

void PushedNodes::set_push(std::size_t i, double length, const Eigen::Vector3d& direction) {
  Eigen::Map<Eigen::Vector3d> push(&push_[3 * i]);
  push.setZero();
  if (length != 0) {
    push = length * inverse_row_sum_[i] * direction;
    Eigen::Map<Eigen::Vector3d>(&total_[3 * i]) += push;
  }
}

void PushedNodes::apply(NodalVectors& parameters) const {
  for (std::size_t i = 0; i < size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> push(&push_[3 * i]);
    if (push.isZero(0)) {
      continue;
    }
    for (std::int64_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      const auto pair = static_cast<std::size_t>(k);
      const auto node = static_cast<std::size_t>(node_[pair]);
      Eigen::Map<Eigen::Vector3d>(&parameters[4 * node]) += inverse_mass_[node] * shape_[pair] * push;
    }
  }
}

double PushedNodes::work(const NodalVectors& before, const NodalVectors& after) const {
  double work = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> push(&total_[3 * i]);
    if (!push.isZero(0)) {
      work += push.dot(place(i, after) - place(i, before)) / 2;
    }
  }
  return work;
}

}  // namespace brainshift::solve
