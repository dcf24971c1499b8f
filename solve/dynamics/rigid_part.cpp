// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/rigid_part.hpp"

#include <algorithm>

#include "solve/body/rigid_motions.hpp"

namespace brainshift::solve {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

}  // namespace

RigidPart::RigidPart(const Points& places) : places_(places.rowwise() - places.colwise().mean()) {
  places_ /= std::max(places_.rowwise().norm().mean(), 1e-9);
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  for (const auto& place : places_.rowwise()) {
    const Eigen::Matrix<double, 3, 6> motions = rigid_motions_at(place);
    squares += motions.transpose() * motions;
  }
  factor_.compute(squares);
}

double RigidPart::longest(const NodalVectors& to, const NodalVectors& from) const {
  const auto moved = [&](std::size_t a) -> Eigen::Vector3d { return (at(to, a) - at(from, a)).head<3>(); };
  const auto nodes = static_cast<std::size_t>(places_.rows());
  const Vector6 none = Vector6::Zero();
  const Vector6 right = sum_over_nodes(
      nodes,
      [&](std::size_t a) -> Vector6 {
        return rigid_motions_at(places_.row(static_cast<Eigen::Index>(a))).transpose() * moved(a);
      },
      none);
  const Vector6 motion = factor_.solve(right);
  double longest = 0;
  for (const auto& place : places_.rowwise()) {
    longest = std::max(longest, (rigid_motions_at(place) * motion).norm());
  }
  return longest;
}

}  // namespace brainshift::solve
