// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/geometry/collinear.hpp"

#include <Eigen/Eigenvalues>

namespace brainshift {

bool are_in_line(const Points& points) {
  constexpr double nearly = 0.02;
  const Points about = points.rowwise() - points.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(about.transpose() * about);
  return spread.eigenvalues()[1] <= nearly * nearly * spread.eigenvalues()[2];
}

}  // namespace brainshift
