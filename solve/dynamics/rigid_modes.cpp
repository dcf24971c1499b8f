// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/rigid_modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "segmentation/geometry/point_tree.hpp"
#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

namespace {

/// From 0 at zero to 1 at one and beyond, without a kink.
double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Root of the mean squared distance from the middle.
double radius_of_gyration(const Points& positions) {
  const Points arms = positions.rowwise() - positions.colwise().mean();
  return std::sqrt(arms.squaredNorm() / static_cast<double>(positions.rows()));
}

}  // namespace

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& inertia) {
  constexpr double independent = 1e-6;  // of the largest: what has less is a combination of others
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> space(inertia);
  Eigen::MatrixXd basis(inertia.rows(), 0);
  for (Eigen::Index i = 0; i < inertia.cols(); ++i) {
    if (space.eigenvalues()[i] > independent * space.eigenvalues().maxCoeff()) {
      basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
      basis.rightCols<1>() = space.eigenvectors().col(i) / std::sqrt(space.eigenvalues()[i]);
    }
  }
  return basis;
}

RigidModes::RigidModes(const Points& positions, std::span<const std::int32_t> held,
                       std::span<const std::vector<std::int32_t>> parts)
    : nodes_(static_cast<std::size_t>(positions.rows())) {
  const Eigen::RowVector3d middle = positions.colwise().mean();
  radius_ = std::sqrt((positions.rowwise() - middle).rowwise().squaredNorm().maxCoeff());
  const Points holds = positions(std::vector<std::int32_t>(held.begin(), held.end()), Eigen::all);
  const double reach = held.empty() ? 0 : std::max(radius_of_gyration(holds), 1e-3 * radius_);
  const PointTree tree(holds);
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    const Eigen::RowVector3d x = positions.row(static_cast<Eigen::Index>(a));
    nodes_[a].arm = (x - middle) / radius_;
    nodes_[a].fade.setOnes();
    if (!held.empty()) {
      const double distance = std::sqrt(tree.nearest(x.data()).second) / reach;
      nodes_[a].fade = {smooth_step(distance / 0.7), smooth_step(distance / 1.4)};
    }
  }
  for (const auto& part : parts.first(std::min(parts.size(), most_parts))) {
    add_part(positions, part);
  }
  gain_ = less_ = Matrix::Zero(motions_, motions_);
}

void RigidModes::add_part(const Points& positions, const std::vector<std::int32_t>& nodes) {
  const Points places = positions(nodes, Eigen::all);
  const Eigen::RowVector3d middle = places.colwise().mean();
  const double radius = std::sqrt((places.rowwise() - middle).rowwise().squaredNorm().maxCoeff());
  for (const std::int32_t a : nodes) {
    Node& node = nodes_[static_cast<std::size_t>(a)];
    node.part = motions_;
    node.in_part = (positions.row(a) - middle) / radius;
  }
  motions_ += 6;
}

Eigen::Vector3d RigidModes::motion(std::size_t node, const Vector& weights) const {
  const auto& [arm, fade, part, in_part] = nodes_[node];
  Eigen::Vector3d moved = fade[0] * (weights.segment<3>(0) + weights.segment<3>(3).cross(arm)) +
                          fade[1] * (weights.segment<3>(6) + weights.segment<3>(9).cross(arm));
  if (part > 0) {
    moved += weights.segment<3>(part) + weights.segment<3>(part + 3).cross(in_part);
  }
  return moved;
}

RigidModes::Vector RigidModes::moments(std::size_t node, const Eigen::Vector3d& force) const {
  const auto& [arm, fade, part, in_part] = nodes_[node];
  Vector m = Vector::Zero(motions_);
  m.head<12>() << fade[0] * force, fade[0] * arm.cross(force), fade[1] * force, fade[1] * arm.cross(force);
  if (part > 0) {
    m.segment<6>(part) << force, in_part.cross(force);
  }
  return m;
}

template <class Force>
RigidModes::Vector RigidModes::moments_of(const Force& force) const {
  const Vector none = Vector::Zero(motions_);
  return sum_over_nodes(
      nodes_.size(), [&](std::size_t a) { return moments(a, force(a)); }, none);
}

RigidModes::Matrix RigidModes::stiffness(const Resistance& resistance, double amplitude) const {
  NodalVectors moved(4 * nodes_.size(), 0.0);
  Matrix columns(motions_, motions_);
  const auto resisting = [&](const Vector& weights) {
    for (std::size_t a = 0; a < nodes_.size(); ++a) {
      at(moved, a).head<3>() = motion(a, weights);
    }
    const NodalVectors& force = resistance(moved);
    return moments_of([&](std::size_t a) -> Eigen::Vector3d { return at(force, a).head<3>(); });
  };
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    columns.col(i) = resisting(amplitude * Vector::Unit(motions_, i));
  }
  columns.colwise() -= resisting(Vector::Zero(motions_));
  return (columns + columns.transpose()) / (2 * amplitude);
}

RigidModes::Matrix RigidModes::inertia(std::span<const double> mass) const {
  Matrix inertia(motions_, motions_);
  for (Eigen::Index i = 0; i < inertia.cols(); ++i) {
    const Vector unit = Vector::Unit(motions_, i);
    inertia.col(i) = moments_of([&](std::size_t a) -> Eigen::Vector3d { return mass[a] * motion(a, unit); });
  }
  return inertia;
}

void RigidModes::weigh(std::span<const double> mass, const Matrix& tissue, const Matrix& contact) {
  constexpr double most = 100;          // of the gains: a free motion has no stiffness
  constexpr double most_contact = 0.1;  // by which contact may raise the largest eigenvalue, one
  gain_.setZero();
  less_.setZero();
  const Eigen::MatrixXd basis = orthonormal(inertia(mass));
  if (basis.cols() == 0) {
    return;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(basis.transpose() * tissue * basis);
  for (Eigen::Index i = 0; i < basis.cols(); ++i) {
    const double gain = quick / std::max(ritz.eigenvalues()[i], quick / (1 + most)) - 1;
    if (gain > 0) {
      const Vector mode = basis * ritz.eigenvectors().col(i);
      const double bounded = std::min(gain, most_contact / std::max(mode.dot(contact * mode), most_contact / most));
      gain_ += bounded * mode * mode.transpose();
      less_ += bounded / (1 + bounded) * mode * mode.transpose();
    }
  }
}

void RigidModes::add(std::span<const double> mass, double beta, const NodalVectors& now, const NodalVectors& before,
                     NodalVectors& next) const {
  if (gain_.isZero(0)) {
    return;
  }
  const Vector weights = gain_ * moments_of([&](std::size_t a) -> Eigen::Vector3d {
                           return mass[a] * (at(next, a) - at(now, a) - beta * (at(now, a) - at(before, a))).head<3>();
                         });
  const auto nodes = static_cast<std::int64_t>(nodes_.size());
  share_work(nodes, nodes_a_part, [&](std::int64_t i) {
    const auto a = static_cast<std::size_t>(i);
    at(next, a).head<3>() += motion(a, weights);
  });
}

double RigidModes::less_inertia(std::span<const double> mass, const NodalVectors& x, const NodalVectors& y) const {
  if (less_.isZero(0)) {
    return 0;
  }
  const Vector m =
      moments_of([&](std::size_t a) -> Eigen::Vector3d { return mass[a] * (at(x, a) - at(y, a)).head<3>(); });
  return m.dot(less_ * m);
}

void RigidModes::lighten(std::span<const double> mass, NodalVectors& v) const {
  const Vector less =
      less_ * moments_of([&](std::size_t a) -> Eigen::Vector3d { return mass[a] * at(v, a).head<3>(); });
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    at(v, a).head<3>() -= motion(a, less);
  }
}

}  // namespace brainshift::solve
