// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/essential_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "solve/shape/shape_matrix.hpp"
#include "solve/shape/too_few_nodes.hpp"

namespace brainshift::solve {

namespace {

constexpr double smallest_pivot = 1e-10;  // of V M⁻¹ Vᵀ, over its diagonal: masses may differ by any factor

Eigen::VectorXd component_of(const NodalVectors& vectors, int axis) {
  using Stride = Eigen::InnerStride<4>;
  return Eigen::Map<const Eigen::VectorXd, 0, Stride>(vectors.data() + axis,
                                                      static_cast<Eigen::Index>(vectors.size() / 4));
}

}  // namespace

EssentialConditions::EssentialConditions(const Points& prescribed, const ShapeRows& nodal_rows,
                                         std::vector<std::int32_t> names, Imposition imposition)
    : names_(std::move(names)), imposition_(imposition) {
  for (int axis = 0; axis < 3; ++axis) {
    Component& c = component_[static_cast<std::size_t>(axis)];
    std::vector<double> values, loaded;
    for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
      const double value = prescribed(a, axis);
      if (std::isinf(value)) {
        throw std::invalid_argument("the prescribed displacement of node " +
                                    std::to_string(names_[static_cast<std::size_t>(a)]) +
                                    " is infinite; give millimetres, or NaN where it is free");
      }
      if (!std::isnan(value)) {
        c.node.push_back(static_cast<std::int32_t>(a));
        values.push_back(value);
        loaded.push_back((prescribed.row(a).array().abs() > 0).any() ? 1.0 : 0.0);
      }
    }
    c.shape = shape_matrix(nodal_rows, c.node, prescribed.rows());
    c.prescribed = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    c.loaded = Eigen::Map<const Eigen::VectorXd>(loaded.data(), static_cast<Eigen::Index>(loaded.size()));
    c.multiplier = c.scratch = Eigen::VectorXd::Zero(c.prescribed.size());
  }
  if (nothing_prescribed()) {
    std::vector<std::int32_t>().swap(names_);  // and its memory
  }
}

bool EssentialConditions::nothing_prescribed() const {
  return std::all_of(component_.begin(), component_.end(), [](const Component& c) { return c.node.empty(); });
}

void EssentialConditions::factorise(std::span<const double> mass) {
  if (nothing_prescribed()) {
    return;
  }
  inverse_mass_.resize(mass.size());
  for (std::size_t a = 0; a < mass.size(); ++a) {
    inverse_mass_[a] = 1 / mass[a];
  }
  const Eigen::Map<const Eigen::VectorXd> inverse(inverse_mass_.data(), static_cast<Eigen::Index>(mass.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Component& c = component_[axis];
    if (c.node.empty()) {
      continue;
    }
    if (imposition_ == Imposition::simplified) {
      const Eigen::VectorXd at_nodes =
          inverse.cwiseProduct(c.shape.cwiseAbs().transpose() * Eigen::VectorXd::Ones(c.prescribed.size()));
      c.lumped = c.shape.cwiseAbs() * at_nodes;
      continue;
    }
    if (axis > 0 && c.node == component_[axis - 1].node) {
      c.factor = component_[axis - 1].factor;
      continue;
    }
    const Eigen::SparseMatrix<double> system = c.shape * inverse.asDiagonal() * c.shape.transpose();
    c.factor = std::make_shared<Factor>(system);
    Eigen::Index worst = 0;
    const auto& [ldlt, pivot] = *c.factor;
    const Eigen::VectorXd diagonal = ldlt.permutationP() * system.diagonal();
    const Eigen::VectorXd pivots = pivot.cwiseQuotient(diagonal);
    if (!(ldlt.info() == Eigen::Success && pivots.minCoeff(&worst) > smallest_pivot)) {
      const auto at = static_cast<std::size_t>(ldlt.permutationPinv().indices()[worst]);
      throw TooFewNodes("the prescribed displacements contradict or repeat each other at node " +
                        std::to_string(names_[static_cast<std::size_t>(c.node[at])]) +
                        ": too many constrained nodes lie too near it; constrain fewer or add free nodes");
    }
  }
}

void EssentialConditions::Factor::solve(Eigen::VectorXd& x, Eigen::VectorXd& scratch) const {
  scratch.noalias() = ldlt.permutationP() * x;
  ldlt.matrixL().solveInPlace(scratch);
  scratch.array() /= pivot.array();
  ldlt.matrixU().solveInPlace(scratch);
  x.noalias() = ldlt.permutationPinv() * scratch;
}

void EssentialConditions::apply(double fraction, NodalVectors& parameters) {
#pragma omp parallel for schedule(static, 1)
  for (int axis = 0; axis < 3; ++axis) {
    Component& c = component_[static_cast<std::size_t>(axis)];
    if (c.node.empty()) {
      continue;
    }
    for (Eigen::Index i = 0; i < c.shape.rows(); ++i) {
      c.multiplier[i] = fraction * c.prescribed[i];
      for (RowMatrix::InnerIterator entry(c.shape, i); entry; ++entry) {
        c.multiplier[i] -=
            entry.value() * parameters[4 * static_cast<std::size_t>(entry.col()) + static_cast<std::size_t>(axis)];
      }
    }
    if (c.factor) {
      c.factor->solve(c.multiplier, c.scratch);
    } else {
      c.multiplier.array() /= c.lumped.array();
    }
    for (Eigen::Index i = 0; i < c.shape.rows(); ++i) {
      for (RowMatrix::InnerIterator entry(c.shape, i); entry; ++entry) {
        const auto node = static_cast<std::size_t>(entry.col());
        parameters[4 * node + static_cast<std::size_t>(axis)] += inverse_mass_[node] * entry.value() * c.multiplier[i];
      }
    }
  }
}

Points EssentialConditions::reactions(double step_squared, std::size_t nodes) const {
  Points forces = Points::Zero(static_cast<Eigen::Index>(nodes), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const Component& c = component_[static_cast<std::size_t>(axis)];
    for (std::size_t i = 0; i < c.node.size(); ++i) {
      forces(c.node[i], axis) = c.multiplier[static_cast<Eigen::Index>(i)] / step_squared;
    }
  }
  return forces;
}

Eigen::Vector3d EssentialConditions::reaction_of_loaded(double step_squared) const {
  Eigen::Vector3d sum;
  for (int axis = 0; axis < 3; ++axis) {
    const Component& c = component_[static_cast<std::size_t>(axis)];
    sum[axis] = c.multiplier.dot(c.loaded) / step_squared;
  }
  return sum;
}

double EssentialConditions::largest_error(double fraction, const NodalVectors& parameters) const {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Component& c = component_[static_cast<std::size_t>(axis)];
    if (!c.node.empty()) {
      largest =
          std::max(largest, (c.shape * component_of(parameters, axis) - fraction * c.prescribed).cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

double EssentialConditions::multiplier_work() const {
  double work = 0;
  for (const Component& c : component_) {
    work += c.multiplier.dot(c.prescribed);
  }
  return work;
}

void EssentialConditions::count_as_held(std::span<const std::int32_t> nodes) {
  for (Component& c : component_) {
    for (std::size_t i = 0; i < c.node.size(); ++i) {
      if (std::binary_search(nodes.begin(), nodes.end(), c.node[i])) {
        c.loaded[static_cast<Eigen::Index>(i)] = 0;
      }
    }
  }
}

}  // namespace brainshift::solve
