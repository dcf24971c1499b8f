// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/best_fit_plane.hpp"

#include <Eigen/Eigenvalues>

namespace brainshift::solve {

Plane3 best_fit_plane(const Points& points) {
  const Eigen::RowVector3d centre = points.colwise().mean();
  const Points about = points.rowwise() - centre;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(about.transpose() * about);
  return {centre, spread.eigenvectors().rowwise().reverse()};
}

}  // namespace brainshift::solve
