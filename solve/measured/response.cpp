// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/response.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <Eigen/QR>
#include <algorithm>

#include "solve/body/rigid_motions.hpp"
#include "solve/material/material.hpp"

namespace brainshift::solve {

namespace {

constexpr double held_stiffness = 1e3;  // of a held direction, over the mean diagonal of K
constexpr double slack = 1e-7;          // added to the diagonal of K, over its mean: rigid motions are taken out of G

Material material_at(const BodyParts& parts, std::int32_t point) {
  return long_term(
      parts.materials
          .material[static_cast<std::size_t>(parts.materials.row_of_point[static_cast<std::size_t>(point)])]);
}

/// µ V (g_a·g_b I + g_b g_aᵀ − 2/3 g_a g_bᵀ) of all pairs of the support.
void add_shear(const ShapeRow& row, double stiffness, Eigen::MatrixXd& k) {
  for (std::size_t a = 0; a < row.size(); ++a) {
    for (std::size_t b = 0; b < row.size(); ++b) {
      const Eigen::Vector3d ga = row.gradient(a), gb = row.gradient(b);
      Eigen::Matrix3d block = gb * ga.transpose() - 2.0 / 3.0 * ga * gb.transpose();
      block.diagonal().array() += ga.dot(gb);
      k.block<3, 3>(3 * row.node[a], 3 * row.node[b]) += stiffness * block;
    }
  }
}

/// K_bulk / V d dᵀ with d the divergence over a patch.
void add_pressure(const BodyParts& parts, std::size_t patch, Eigen::VectorXd& divergence, Eigen::MatrixXd& k) {
  std::vector<std::int32_t> nodes;
  double volume = 0;
  const auto begin = parts.patches.order.begin() + parts.patches.begin[patch];
  const auto end = parts.patches.order.begin() + parts.patches.begin[patch + 1];
  for (auto p = begin; p != end; ++p) {
    const auto point = static_cast<std::size_t>(*p);
    const ShapeRow row = parts.point_rows[point];
    for (std::size_t a = 0; a < row.size(); ++a) {
      divergence.segment<3>(3 * row.node[a]) += parts.points.volume[point] * row.gradient(a);
      nodes.push_back(row.node[a]);
    }
    volume += parts.points.volume[point];
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const double stiffness = bulk_modulus(material_at(parts, *begin)) / volume;
  for (const std::int32_t a : nodes) {
    for (const std::int32_t b : nodes) {
      k.block<3, 3>(3 * a, 3 * b) +=
          stiffness * divergence.segment<3>(3 * a) * divergence.segment<3>(3 * b).transpose();
    }
  }
  for (const std::int32_t a : nodes) {
    divergence.segment<3>(3 * a).setZero();
  }
}

Eigen::MatrixXd stiffness_of(const BodyParts& parts) {
  const auto size = static_cast<Eigen::Index>(3 * parts.cloud.size());
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t p = 0; p < parts.points.size(); ++p) {
    add_shear(parts.point_rows[p],
              shear_modulus(material_at(parts, static_cast<std::int32_t>(p))) * parts.points.volume[p], k);
  }
  Eigen::VectorXd divergence = Eigen::VectorXd::Zero(size);
  for (std::size_t patch = 0; patch < parts.patches.size(); ++patch) {
    add_pressure(parts, patch, divergence, k);
  }
  return k;
}

/// Outward at a surface node: away from the mean of the nodes about it.
Eigen::Vector3d outward(const NodeCloud& cloud, Eigen::Index node) {
  const Eigen::RowVector3d x = cloud.positions.row(node);
  const double reach = 2.5 * cloud.spacing[static_cast<std::size_t>(node)];
  Eigen::RowVector3d away = Eigen::RowVector3d::Zero();
  for (const auto& other : cloud.positions.rowwise()) {
    if ((other - x).norm() <= reach) {
      away += x - other;
    }
  }
  return away.transpose().normalized();
}

/// Whether what is prescribed at a node is held, not measured.
bool is_held(const Conditions& conditions, Eigen::Index node, int axis) {
  return conditions.is_prescribed(node, axis) && !is_measured(conditions, node);
}

/// K with what holds the body. Returns whether anything does.
bool hold(const NodeCloud& cloud, const Conditions& conditions, bool touches, Eigen::MatrixXd& k) {
  const double stiff = held_stiffness * k.diagonal().mean();
  bool held = touches;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    for (int axis = 0; axis < 3; ++axis) {
      if (is_held(conditions, a, axis)) {
        k(3 * a + axis, 3 * a + axis) += stiff;
        held = true;
      }
    }
    if (touches && cloud.on_surface[static_cast<std::size_t>(a)] != 0 && !conditions.is_prescribed(a)) {
      const Eigen::Vector3d normal = outward(cloud, a);
      k.block<3, 3>(3 * a, 3 * a) += stiff * normal * normal.transpose();
    }
  }
  return held;
}

/// Φ for vectors: (3n × 3m), a column a component of a point.
Eigen::MatrixXd loads_at(const ShapeRows& at_points, std::size_t nodes) {
  Eigen::MatrixXd loads =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * nodes), static_cast<Eigen::Index>(3 * at_points.size()));
  for (std::size_t i = 0; i < at_points.size(); ++i) {
    const ShapeRow row = at_points[i];
    for (std::size_t a = 0; a < row.size(); ++a) {
      loads.block<3, 3>(3 * row.node[a], static_cast<Eigen::Index>(3 * i)).diagonal().setConstant(row.value[a]);
    }
  }
  return loads;
}

}  // namespace

bool is_measured(const Conditions& conditions, Eigen::Index node) {
  return conditions.measured && conditions.measured->spread.cols() > 0 &&  // Eigen reads past one without columns
         conditions.measured->spread.row(node).norm() > 0;
}

Eigen::MatrixXd rigid_motions(const Points& places, const Points& about) {
  const Eigen::RowVector3d centre = about.colwise().mean();
  const double size = (about.rowwise() - centre).rowwise().norm().mean();
  Eigen::MatrixXd motions(3 * places.rows(), 6);
  for (Eigen::Index a = 0; a < places.rows(); ++a) {
    const Eigen::Vector3d x = (places.row(a) - centre).transpose() / (size > 0 ? size : 1);
    motions.middleRows<3>(3 * a) = rigid_motions_at(x);
  }
  return motions;
}

StiffBody stiff_body(const BodyParts& parts, bool touches) {
  return {parts.cloud, stiffness_of(parts), touches};
}

Response linear_response(const StiffBody& body, const Conditions& conditions, const ShapeRows& at_points) {
  Eigen::MatrixXd k = body.stiffness;
  const bool held = hold(body.cloud, conditions, body.touches && !mostly_prescribed(body.cloud, conditions), k);
  k.diagonal().array() += slack * k.diagonal().mean();
  const Eigen::MatrixXd observed = loads_at(at_points, body.cloud.size());
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(k);
  if (held) {
    return {observed.transpose() * factor.solve(observed), Eigen::MatrixXd(observed.cols(), 0), false};
  }
  const Eigen::MatrixXd motions = rigid_motions(body.cloud.positions, body.cloud.positions);
  const Eigen::MatrixXd basis =
      Eigen::HouseholderQR<Eigen::MatrixXd>(motions).householderQ() * Eigen::MatrixXd::Identity(motions.rows(), 6);
  const Eigen::MatrixXd balanced = observed - basis * (basis.transpose() * observed);
  Eigen::MatrixXd moved = factor.solve(balanced);
  moved -= basis * (basis.transpose() * moved);
  return {observed.transpose() * moved, observed.transpose() * motions, true};
}

Carried carried_motion(const StiffBody& body, const Conditions& conditions, const ShapeRows& at_nodes,
                       const ShapeRows& at_points) {
  Carried carried;
  std::vector<std::int32_t> rows;
  for (Eigen::Index a = 0; a < body.cloud.positions.rows(); ++a) {
    if (is_measured(conditions, a)) {
      carried.nodes.push_back(a);
      rows.push_back(static_cast<std::int32_t>(a));
    }
  }
  Eigen::MatrixXd k = body.stiffness;
  const double stiff = held_stiffness * k.diagonal().mean();
  hold(body.cloud, conditions, body.touches, k);
  const Eigen::MatrixXd held = loads_at(rows_at(at_nodes, rows), body.cloud.size());
  k += stiff * held * held.transpose();
  const Eigen::MatrixXd push = stiff * held;
  k.diagonal().array() += slack * k.diagonal().mean();
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(k);
  carried.motion = loads_at(at_points, body.cloud.size()).transpose() * factor.solve(push);
  return carried;
}

}  // namespace brainshift::solve
