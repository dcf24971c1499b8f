// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {

/// A turn about the origin, then a move: y = R x + t, mm, LPS.
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Points operator()(const Points& places) const {
    return (places * rotation.transpose()).rowwise() + translation.transpose();
  }
  /// Where y came from: Rᵀ (y − t).
  Points back(const Points& places) const { return (places.rowwise() - translation.transpose()) * rotation; }
  /// Degrees.
  double angle() const;
};

/// The rigid motion that takes places nearest to others, in squares over the mean variance of each (Kabsch 1976).
/// sigma: (m × 3) mm, or no rows: all alike.
RigidMotion fit_rigid(const Points& from, const Points& to, const Points& sigma);

/// The load in the frame of the image: a place that is measured at y lies at T⁻¹ y there. Standard deviations are along
/// the tracker's axes: each axis of the image takes that of the nearest. Turned as a covariance, one that is large, of
/// a component that nobody measured, would spoil the others.
CraniotomyLoad registered(const CraniotomyLoad& load, const RigidMotion& motion);

/// An ITK text transform (.tfm): takes places of the image to where the tracker sees them. Throws std::runtime_error,
/// naming the file.
void write_rigid(const std::filesystem::path& file, const RigidMotion& motion);

}  // namespace brainshift::solve
