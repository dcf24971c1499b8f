// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/matching.hpp"

#include "solve/shape/too_few_nodes.hpp"

namespace brainshift::solve {

namespace {

constexpr Eigen::Index kept_node = -1;
constexpr double hold = 1e-3;  // of the mean pull of the rows on a parameter, towards the displacement at its node

/// One row of the system for each row of shape functions and component of what is to agree.
void append(const ShapeRows& rows, std::span<const double> of_pairs, int components, double factor, Eigen::Index first,
            std::vector<Eigen::Triplet<double>>& entries) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (auto k = static_cast<std::size_t>(rows.begin[i]); k < static_cast<std::size_t>(rows.begin[i + 1]); ++k) {
      for (int c = 0; c < components; ++c) {
        entries.emplace_back(first + static_cast<Eigen::Index>(i) * components + c, rows.node[k],
                             factor * of_pairs[k * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)]);
      }
    }
  }
}

/// The vectors' first three components, one row a node.
Points points_of(const NodalVectors& vectors, Eigen::Index nodes) {
  Points points = Points::Zero(nodes, 3);
  for (std::size_t a = 0; a < vectors.size() / 4; ++a) {
    points.row(static_cast<Eigen::Index>(a)) = at(vectors, a).head<3>();
  }
  return points;
}

}  // namespace

Matching::Matching(std::vector<std::int32_t> nodes, std::size_t count)
    : nodes_(std::move(nodes)), unknown_(count, kept_node) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    unknown_[static_cast<std::size_t>(nodes_[i])] = static_cast<Eigen::Index>(i);
  }
}

void Matching::agree_in_value(const ShapeRows& before, const ShapeRows& after) {
  append(before, before.value, 1, 1, rows_, before_entries_);
  append(after, after.value, 1, 1, rows_, after_entries_);
  rows_ += static_cast<Eigen::Index>(after.size());
}

void Matching::agree_in_gradient(const ShapeRows& before, const ShapeRows& after, double length) {
  append(before, before.derivative, 3, length, rows_, before_entries_);
  append(after, after.derivative, 3, length, rows_, after_entries_);
  rows_ += 3 * static_cast<Eigen::Index>(after.size());
}

void Matching::factorise() {
  if (nodes_.empty()) {
    return;  // the cut has not come to the body
  }
  const auto count = static_cast<Eigen::Index>(unknown_.size());
  before_.resize(rows_, count);
  before_.setFromTriplets(before_entries_.begin(), before_entries_.end());
  Entries chosen, kept;
  for (const auto& entry : after_entries_) {
    const Eigen::Index column = unknown_[static_cast<std::size_t>(entry.col())];
    if (column == kept_node) {
      kept.push_back(entry);
    } else {
      chosen.emplace_back(entry.row(), column, entry.value());
    }
  }
  after_.resize(rows_, count);
  after_.setFromTriplets(kept.begin(), kept.end());
  chosen_.resize(rows_, static_cast<Eigen::Index>(nodes_.size()));
  chosen_.setFromTriplets(chosen.begin(), chosen.end());
  Eigen::SparseMatrix<double> system = chosen_.transpose() * chosen_;
  pull_ = hold * system.diagonal().mean();
  for (Eigen::Index i = 0; i < system.rows(); ++i) {
    system.coeffRef(i, i) += pull_;
  }
  factor_.compute(system);
  if (factor_.info() != Eigen::Success) {
    throw TooFewNodes("the displacement could not be carried over to the body after a cut");
  }
}

NodalVectors Matching::operator()(const NodalVectors& before) const {
  if (nodes_.empty()) {
    return before;
  }
  const Points old = points_of(before, static_cast<Eigen::Index>(unknown_.size()));
  const Eigen::MatrixXd wanted = before_ * old, left = wanted - after_ * old;
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  const Eigen::MatrixXd solved = factor_.solve(chosen_.transpose() * left + pull_ * wanted.topRows(count));
  NodalVectors result = before;
  result.resize(4 * unknown_.size(), 0.0);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    at(result, static_cast<std::size_t>(nodes_[i])).head<3>() = solved.row(static_cast<Eigen::Index>(i));
  }
  return result;
}

}  // namespace brainshift::solve
