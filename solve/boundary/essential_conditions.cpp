// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/essential_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "solve/arrays/shared_work.hpp"
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

bool same_columns(const Points& values) {
  return values.rows() == 0 || (values.col(0) == values.col(1) && values.col(0) == values.col(2));
}

Eigen::VectorXd stacked(const Eigen::VectorXd& above, const Eigen::VectorXd& below) {
  Eigen::VectorXd both(above.size() + below.size());
  both << above, below;
  return both;
}

/// C of the conditions of the nodes, then of the inner points; mm². extension: EssentialConditions::Component.
Eigen::SparseMatrix<double> compliance(const Measurement& measured, const EssentialConditions::RowMatrix& extension,
                                       int axis) {
  const EssentialConditions::RowMatrix spread = measured.spread;
  const EssentialConditions::RowMatrix at_conditions = extension * spread;
  Eigen::SparseMatrix<double> root(extension.rows() + measured.inner.rows(),
                                   measured.sigma.rows() + measured.inner.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < at_conditions.rows(); ++i) {
    for (EssentialConditions::RowMatrix::InnerIterator entry(at_conditions, i); entry; ++entry) {
      entries.emplace_back(static_cast<int>(i), static_cast<int>(entry.col()),
                           entry.value() * measured.sigma(entry.col(), axis));
    }
  }
  for (Eigen::Index i = 0; i < measured.inner.rows(); ++i) {
    entries.emplace_back(static_cast<int>(extension.rows() + i), static_cast<int>(measured.sigma.rows() + i),
                         measured.inner_sigma(i, axis));
  }
  root.setFromTriplets(entries.begin(), entries.end());
  return root * root.transpose();
}

/// The nodes at which a component is prescribed.
std::vector<std::int32_t> nodes_of_component(const Points& prescribed, int axis) {
  std::vector<std::int32_t> nodes;
  for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
    if (!std::isnan(prescribed(a, axis))) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

/// 1 where any component is not 0.
Eigen::VectorXd loaded_at(std::span<const std::int32_t> nodes, const Points& prescribed) {
  Eigen::VectorXd loaded(static_cast<Eigen::Index>(nodes.size()));
  std::transform(nodes.begin(), nodes.end(), loaded.begin(),
                 [&](std::int32_t a) { return (prescribed.row(a).array().abs() > 0).any() ? 1.0 : 0.0; });
  return loaded;
}

/// Rows of the conditions of these nodes: those at the nodes, or, of nodes on a rim, others.
ShapeRows rows_of_conditions(std::span<const std::int32_t> nodes, const PatchRim& rim, const ShapeRows& at_rim,
                             const std::function<void(std::int32_t, ShapeRows&)>& append_at_node) {
  ShapeRows rows;
  for (const std::int32_t a : nodes) {
    const auto found = std::lower_bound(rim.node.begin(), rim.node.end(), a);
    if (found != rim.node.end() && *found == a) {
      rows.append(at_rim[static_cast<std::size_t>(found - rim.node.begin())]);
    } else {
      append_at_node(a, rows);
    }
  }
  return rows;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> stacked(const Eigen::SparseMatrix<double, Eigen::RowMajor>& above,
                                                     const Eigen::SparseMatrix<double, Eigen::RowMajor>& below) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> both(above.rows() + below.rows(), above.cols());
  both.topRows(above.rows()) = above;
  both.bottomRows(below.rows()) = below;
  return both;
}

/// Where a system is singular: the condition of its least pivot. Nothing: it is not.
std::optional<std::size_t> repeated_condition(const EssentialConditions::Factor& factor,
                                              const Eigen::SparseMatrix<double>& system) {
  Eigen::Index worst = 0;
  const auto& [ldlt, pivot] = factor;
  const Eigen::VectorXd diagonal = ldlt.permutationP() * system.diagonal();
  const Eigen::VectorXd pivots = pivot.cwiseQuotient(diagonal);
  const double least = pivots.minCoeff(&worst);
  if (ldlt.info() == Eigen::Success && least > smallest_pivot) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(ldlt.permutationPinv().indices()[worst]);
}

}  // namespace

EssentialConditions::EssentialConditions(const Points& prescribed, const ShapeRows& nodal_rows,
                                         std::vector<std::int32_t> names, Imposition imposition, const PatchRim& rim)
    : names_(std::move(names)), imposition_(imposition) {
  const auto shape_at = [&](std::int32_t a, ShapeRows& rows) { rows.append(nodal_rows[static_cast<std::size_t>(a)]); };
  const auto own_value = [](std::int32_t a, ShapeRows& rows) {
    constexpr double one = 1;
    rows.append({std::span(&a, 1), std::span(&one, 1), {}});
  };
  for (int axis = 0; axis < 3; ++axis) {
    Component& c = component_[static_cast<std::size_t>(axis)];
    c.node = nodes_of_component(prescribed, axis);
    c.shape = shape_matrix(rows_of_conditions(c.node, rim, rim.rows, shape_at), prescribed.rows());
    c.extension = shape_matrix(rows_of_conditions(c.node, rim, rim.extension, own_value), prescribed.rows());
    c.prescribed = c.extension * prescribed.col(axis);  // of free nodes no value is in it
    c.loaded = loaded_at(c.node, prescribed);
    c.multiplier = c.scratch = Eigen::VectorXd::Zero(c.prescribed.size());
  }
  if (nothing_prescribed()) {
    std::vector<std::int32_t>().swap(names_);  // and its memory
  }
}

EssentialConditions::EssentialConditions(const Points& prescribed, const ShapeRows& nodal_rows,
                                         std::vector<std::int32_t> names, const Measurement& measured,
                                         const ShapeRows& inner_rows, const PatchRim& rim)
    : EssentialConditions(prescribed, nodal_rows, names, Imposition::exact, rim) {
  constexpr double millijoule = 1e6;  // µN mm
  const double weight = millijoule * measured.weight;
  names_ = std::move(names);
  const RowMatrix inner_shape = shape_matrix(inner_rows, prescribed.rows());
  same_compliance_ = same_columns(measured.sigma) && same_columns(measured.inner_sigma);
  for (int axis = 0; axis < 3; ++axis) {
    Component& c = component_[static_cast<std::size_t>(axis)];
    c.compliance = compliance(measured, c.extension, axis) / weight;
    if (measured.inner.rows() > 0) {
      c.shape = stacked(c.shape, inner_shape);
      c.prescribed = stacked(c.prescribed, measured.inner_displacement.col(axis));
      c.loaded = stacked(c.loaded, Eigen::VectorXd::Ones(measured.inner.rows()));
    }
    c.multiplier = c.scratch = c.multiplier_before = Eigen::VectorXd::Zero(c.prescribed.size());
  }
}

bool EssentialConditions::prescribe(const Points& prescribed) {
  if (give_way()) {
    return false;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (nodes_of_component(prescribed, static_cast<int>(axis)) != component_[axis].node) {
      return false;
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Component& c = component_[axis];
    c.prescribed = c.extension * prescribed.col(static_cast<Eigen::Index>(axis));
    c.loaded = loaded_at(c.node, prescribed);
    c.multiplier.setZero();
  }
  fraction_ = {0, 0};
  return true;
}

bool EssentialConditions::give_way() const {
  return std::any_of(component_.begin(), component_.end(), [](const Component& c) { return c.compliance.rows() > 0; });
}

bool EssentialConditions::nothing_prescribed() const {
  return std::all_of(component_.begin(), component_.end(), [](const Component& c) { return c.prescribed.size() == 0; });
}

std::vector<std::int32_t> EssentialConditions::nodes() const {
  std::set<std::int32_t> nodes;
  for (const Component& c : component_) {
    for (Eigen::Index i = 0; i < c.shape.rows(); ++i) {
      for (RowMatrix::InnerIterator entry(c.shape, i); entry; ++entry) {
        nodes.insert(static_cast<std::int32_t>(entry.col()));
      }
    }
  }
  return {nodes.begin(), nodes.end()};
}

bool EssentialConditions::is_factorised(double alpha) const {
  return std::all_of(component_.begin(), component_.end(), [&](const Component& c) {
    return c.prescribed.size() == 0 || (c.factor && (c.compliance.rows() == 0 || alpha == alpha_));
  });
}

void EssentialConditions::factorise(std::span<const double> mass, double alpha) {
  if (nothing_prescribed()) {
    return;
  }
  std::vector<double> inverse_mass(mass.size());
  std::transform(mass.begin(), mass.end(), inverse_mass.begin(), [](double m) { return 1 / m; });
  if (inverse_mass == inverse_mass_ && is_factorised(alpha)) {
    return;
  }
  alpha_ = alpha;
  inverse_mass_ = std::move(inverse_mass);
  for (Component& c : component_) {
    c.factor.reset();
  }
  const Eigen::Map<const Eigen::VectorXd> inverse(inverse_mass_.data(), static_cast<Eigen::Index>(mass.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Component& c = component_[axis];
    if (c.prescribed.size() == 0) {
      continue;
    }
    if (imposition_ == Imposition::simplified) {
      const Eigen::VectorXd at_nodes =
          inverse.cwiseProduct(c.shape.cwiseAbs().transpose() * Eigen::VectorXd::Ones(c.prescribed.size()));
      c.lumped = c.shape.cwiseAbs() * at_nodes;
      continue;
    }
    if (axis > 0 && same_compliance_ && c.node == component_[axis - 1].node) {
      c.factor = component_[axis - 1].factor;
      continue;
    }
    Eigen::SparseMatrix<double> system = c.shape * inverse.asDiagonal() * c.shape.transpose();
    if (c.compliance.rows() > 0) {
      system += c.compliance / alpha;
    }
    auto factor = std::make_shared<Factor>(system);
    if (const std::optional<std::size_t> at = repeated_condition(*factor, system)) {
      throw TooFewNodes("the prescribed displacements contradict or repeat each other at " +
                        (*at < c.node.size() ? "node " + std::to_string(names_[static_cast<std::size_t>(c.node[*at])])
                                             : "inner measured point " + std::to_string(*at - c.node.size() + 1)) +
                        ": too many constrained nodes lie too near it; constrain fewer or add free nodes");
    }
    c.factor = std::move(factor);
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
  fraction_ = {fraction_[1], fraction};
  share_work(3, 1, [&](std::int64_t axis) {
    Component& c = component_[static_cast<std::size_t>(axis)];
    if (c.prescribed.size() == 0) {
      return;
    }
    if (c.multiplier_before.size() > 0) {
      std::swap(c.multiplier, c.multiplier_before);
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
  });
}

Points EssentialConditions::reactions(double step_squared, std::size_t nodes) const {
  std::vector<double> multipliers;
  for (const Component& c : component_) {
    multipliers.insert(multipliers.end(), c.multiplier.begin(), c.multiplier.end());
  }
  return reactions(step_squared, nodes, multipliers);
}

Points EssentialConditions::reactions(double step_squared, std::size_t nodes,
                                      std::span<const double> multipliers) const {
  Points forces = Points::Zero(static_cast<Eigen::Index>(nodes), 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Component& c = component_[axis];
    for (std::size_t i = 0; i < c.node.size(); ++i) {
      forces(c.node[i], static_cast<Eigen::Index>(axis)) = multipliers[i] / step_squared;
    }
    multipliers = multipliers.subspan(static_cast<std::size_t>(c.prescribed.size()));
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
    if (c.prescribed.size() > 0) {
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

double EssentialConditions::spring_work(const NodalVectors& before, const NodalVectors& now) const {
  double work = 0;
  for (int axis = 0; axis < 3 && fraction_[0] == fraction_[1]; ++axis) {
    const Component& c = component_[static_cast<std::size_t>(axis)];
    if (c.multiplier_before.size() > 0) {
      const Eigen::VectorXd moved = c.shape * (component_of(now, axis) - component_of(before, axis));
      work -= moved.dot(c.multiplier - c.multiplier_before);
    }
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
