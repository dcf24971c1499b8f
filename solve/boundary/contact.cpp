// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift::solve {

Contact::Contact(SignedDistance skull, const Points& positions, std::vector<std::int32_t> nodes, const ShapeRows& rows)
    : skull_(std::move(skull)), positions_(static_cast<Eigen::Index>(nodes.size()), 3), begin_{0} {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const ShapeRow row = rows[static_cast<std::size_t>(nodes[i])];
    node_.insert(node_.end(), row.node.begin(), row.node.end());
    shape_.insert(shape_.end(), row.value.begin(), row.value.end());
    begin_.push_back(static_cast<std::int64_t>(node_.size()));
    positions_.row(static_cast<Eigen::Index>(i)) = positions.row(nodes[i]);
    allowed_.push_back(std::max(0.0, skull_.value(positions.row(nodes[i]))));
  }
  correction_.resize(3 * nodes.size());
}

void Contact::weigh(std::span<const double> mass) {
  inverse_mass_.resize(mass.size());
  std::transform(mass.begin(), mass.end(), inverse_mass_.begin(), [](double m) { return 1 / m; });
  std::vector<double> column_sum(mass.size(), 0.0);
  for (std::size_t k = 0; k < node_.size(); ++k) {
    column_sum[static_cast<std::size_t>(node_[k])] += std::abs(shape_[k]);
  }
  inverse_row_sum_.assign(allowed_.size(), 0.0);
  for (std::size_t i = 0; i < allowed_.size(); ++i) {
    double sum = 0;
    for (std::int64_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      const auto pair = static_cast<std::size_t>(k);
      const auto node = static_cast<std::size_t>(node_[pair]);
      sum += std::abs(shape_[pair]) * inverse_mass_[node] * column_sum[node];
    }
    inverse_row_sum_[i] = 1 / sum;
  }
}

Eigen::Vector3d Contact::place(std::size_t i, const NodalVectors& parameters) const {
  Eigen::Vector3d x = positions_.row(static_cast<Eigen::Index>(i));
  for (std::int64_t k = begin_[i]; k < begin_[i + 1]; ++k) {
    const auto pair = static_cast<std::size_t>(k);
    x += shape_[pair] * Eigen::Map<const Eigen::Vector3d>(&parameters[4 * static_cast<std::size_t>(node_[pair])]);
  }
  return x;
}

void Contact::apply(NodalVectors& parameters) {
  const auto nodes = static_cast<std::int64_t>(allowed_.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t a = 0; a < nodes; ++a) {
    const auto i = static_cast<std::size_t>(a);
    const Eigen::Vector3d x = place(i, parameters);
    const double outside = skull_.value(x) - allowed_[i];
    Eigen::Map<Eigen::Vector3d> correction(&correction_[3 * i]);
    correction.setZero();
    if (outside > 0) {
      correction = -outside * inverse_row_sum_[i] * skull_.gradient(x);
    }
  }
  for (std::size_t i = 0; i < allowed_.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> correction(&correction_[3 * i]);
    if (correction.isZero(0)) {
      continue;
    }
    for (std::int64_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      const auto pair = static_cast<std::size_t>(k);
      const auto node = static_cast<std::size_t>(node_[pair]);
      Eigen::Map<Eigen::Vector3d>(&parameters[4 * node]) += inverse_mass_[node] * shape_[pair] * correction;
    }
  }
}

double Contact::push_work(const NodalVectors& before, const NodalVectors& after) const {
  double work = 0;
  for (std::size_t i = 0; i < allowed_.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> push(&correction_[3 * i]);
    if (!push.isZero(0)) {
      work += push.dot(place(i, after) - place(i, before)) / 2;
    }
  }
  return work;
}

Contact::Measures Contact::measure(const NodalVectors& parameters) const {
  constexpr double rounding = 1e-4;  // mm, of samples in single precision
  Measures measures;
  for (std::size_t i = 0; i < allowed_.size(); ++i) {
    const double distance = skull_.value(place(i, parameters)), outside = distance - allowed_[i];
    measures.lost = measures.lost || distance > skull_.horizon() - rounding;
    measures.touching += outside > -0.01 ? 1 : 0;
    measures.largest_penetration = std::max(measures.largest_penetration, outside);
  }
  return measures;
}

}  // namespace brainshift::solve
