// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/rigid_fit.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "segmentation/files/not_written.hpp"

namespace brainshift::solve {

double RigidMotion::angle() const {
  return Eigen::AngleAxisd(rotation).angle() * 180 / std::numbers::pi;
}

RigidMotion fit_rigid(const Points& from, const Points& to, const Points& sigma) {
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(from.rows());
  if (sigma.rows() > 0) {
    weight = sigma.rowwise().squaredNorm().cwiseInverse();
  }
  weight /= weight.sum();
  const Eigen::RowVector3d centre = weight.transpose() * from, target = weight.transpose() * to;
  const Eigen::Matrix3d moment = (from.rowwise() - centre).transpose() * weight.asDiagonal() * (to.rowwise() - target);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixV() * svd.matrixU().transpose()).determinant() > 0 ? 1 : -1;
  RigidMotion motion;
  motion.rotation = svd.matrixV() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixU().transpose();
  motion.translation = target.transpose() - motion.rotation * centre.transpose();
  return motion;
}

namespace {

/// Of each axis of the image the tracker's that it is nearest to, each of them once.
std::array<int, 3> nearest_axes(const Eigen::Matrix3d& rotation) {
  std::array<int, 3> axes = {0, 1, 2}, best = axes;
  double most = 0;
  do {
    const double near =
        std::abs(rotation(axes[0], 0)) + std::abs(rotation(axes[1], 1)) + std::abs(rotation(axes[2], 2));
    if (near > most) {
      most = near;
      best = axes;
    }
  } while (std::ranges::next_permutation(axes).found);
  return best;
}

}  // namespace

CraniotomyLoad registered(const CraniotomyLoad& load, const RigidMotion& motion) {
  CraniotomyLoad turned{load.positions, motion.back(load.positions + load.displacement) - load.positions, load.sigma};
  if (load.sigma.rows() > 0) {
    const std::array<int, 3> axes = nearest_axes(motion.rotation);
    turned.sigma = load.sigma(Eigen::all, axes);
  }
  return turned;
}

void write_rigid(const std::filesystem::path& file, const RigidMotion& motion) {
  std::ofstream stream(file);
  stream.precision(std::numeric_limits<double>::max_digits10);
  stream << "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\nParameters:";
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      stream << ' ' << motion.rotation(row, column);
    }
  }
  stream << ' ' << motion.translation.transpose() << "\nFixedParameters: 0 0 0\n";
  if (!stream.flush()) {
    fail_to_write(file);
  }
}

}  // namespace brainshift::solve
