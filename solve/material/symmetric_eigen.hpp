// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace brainshift::solve {

struct SymmetricEigen {
  Eigen::Vector3d values;   ///< in no particular order
  Eigen::Matrix3d vectors;  ///< columns, orthonormal
};

/// Eigenvalues and eigenvectors of a symmetric (3 × 3) matrix to rounding error, equal eigenvalues included: the one
/// that is farthest from the other two in closed form, then the remaining pair by one rotation. A NaN gives NaN.
/// Scherzinger & Dohrmann 2008 (Comput. Methods Appl. Mech. Engrg. 197:4007). Eigen's computeDirect is as fast, but
/// off by 1e-8 where eigenvalues meet, which is the state of rest; its iterative compute takes 2.5 times as long.
SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix);

}  // namespace brainshift::solve
