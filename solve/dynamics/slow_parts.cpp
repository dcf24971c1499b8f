// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/slow_parts.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solve/body/rigid_motions.hpp"
#include "solve/dynamics/rigid_modes.hpp"

namespace brainshift::solve {

namespace {

using SixMotions = Eigen::Matrix<double, 3, 6>;  // of one node
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Three shifts, and three turns about the middle of the part that move its outermost node as far.
std::vector<SixMotions> rigid_motions(const Body& body, const std::vector<std::int32_t>& part) {
  Points places(static_cast<Eigen::Index>(part.size()), 3);
  for (std::size_t i = 0; i < part.size(); ++i) {
    places.row(static_cast<Eigen::Index>(i)) = body.positions.row(body.original[static_cast<std::size_t>(part[i])]);
  }
  const Points arms = places.rowwise() - places.colwise().mean();
  const double radius = std::sqrt(arms.rowwise().squaredNorm().maxCoeff());
  std::vector<SixMotions> motions;
  for (const auto& row : arms.rowwise()) {
    motions.push_back(rigid_motions_at(row / radius));
  }
  return motions;
}

/// Of (K, M) within the space of M; K symmetric.
double least_eigenvalue(const Matrix6& stiffness, const Matrix6& inertia) {
  const Eigen::MatrixXd basis = orthonormal(inertia);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(basis.transpose() * stiffness * basis,
                                                            Eigen::EigenvaluesOnly);
  return ritz.eigenvalues().minCoeff();
}

}  // namespace

NodeLists free_stiff_parts(const Body& body) {
  NodeLists parts = body.stiff_parts;
  if (parts.empty()) {
    return parts;
  }
  const std::vector<std::int32_t> held = body.essential.nodes();
  std::erase_if(parts, [&](const std::vector<std::int32_t>& part) {
    return std::ranges::any_of(part, [&](std::int32_t a) { return std::ranges::binary_search(held, a); });
  });
  return parts;
}

NodeLists parts_without_modes(const Body& body) {
  NodeLists with = free_stiff_parts(body), parts = body.stiff_parts;
  with.resize(std::min(with.size(), RigidModes::most_parts));
  std::erase_if(parts, [&](const auto& part) { return std::ranges::find(with, part) != with.end(); });
  return parts;
}

NodalVectors with_rigid_parts(const Body& body, NodalVectors parameters) {
  for (const std::vector<std::int32_t>& part : body.stiff_parts) {
    Eigen::Matrix3Xd from(3, part.size()), to(3, part.size());
    for (std::size_t k = 0; k < part.size(); ++k) {
      const auto a = static_cast<std::size_t>(part[k]);
      const auto column = static_cast<Eigen::Index>(k);
      from.col(column) = body.positions.row(body.original[a]).transpose();
      to.col(column) = from.col(column) + at(parameters, a).head<3>();
    }
    const Eigen::Matrix4d motion = Eigen::umeyama(from, to, false);
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Eigen::Vector3d x = from.col(static_cast<Eigen::Index>(k));
      at(parameters, static_cast<std::size_t>(part[k])).head<3>() =
          motion.topLeftCorner<3, 3>() * x + motion.topRightCorner<3, 1>() - x;
    }
  }
  return parameters;
}

double slowest_rigid_motion(const Body& body, const NodeLists& parts, std::span<const double> mass,
                            const NodalVectors& now, ForceScratch& scratch) {
  constexpr double small = 1e-3;  // of a spacing: straight enough, and far above what single precision rounds
  double slowest = std::numeric_limits<double>::infinity();
  if (parts.empty()) {
    return slowest;
  }
  const double amplitude = small * body.spacing.front();
  NodalVectors state = now, rest(now.size()), force(now.size());
  internal_force(body.points, body.laws, now, scratch, rest);
  for (const std::vector<std::int32_t>& part : parts) {
    const std::vector<SixMotions> motions = rigid_motions(body, part);
    Matrix6 stiffness = Matrix6::Zero(), inertia = Matrix6::Zero();
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (std::size_t k = 0; k < part.size(); ++k) {
        const auto a = static_cast<std::size_t>(part[k]);
        at(state, a).head<3>() = at(now, a).head<3>() + amplitude * motions[k].col(i);
      }
      internal_force(body.points, body.laws, state, scratch, force);
      for (std::size_t k = 0; k < part.size(); ++k) {
        const auto a = static_cast<std::size_t>(part[k]);
        stiffness.col(i) += motions[k].transpose() * (at(force, a) - at(rest, a)).head<3>() / amplitude;
        inertia.col(i) += mass[a] * motions[k].transpose() * motions[k].col(i);
      }
    }
    for (const std::int32_t node : part) {
      at(state, static_cast<std::size_t>(node)) = at(now, static_cast<std::size_t>(node));
    }
    slowest = std::min(slowest, least_eigenvalue((stiffness + stiffness.transpose()) / 2, inertia));
  }
  internal_force(body.points, body.laws, now, scratch, force);
  return slowest;
}

}  // namespace brainshift::solve
