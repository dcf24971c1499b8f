// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "solve/interface/result.hpp"
#include "solve/measured/response.hpp"

namespace brainshift::solve {

inline constexpr double millijoule = 1e6;  // µN mm

/// (m · 3) of (m × 3), x, y and z of the first point first.
inline Eigen::VectorXd stacked_rows(const Points& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
}

/// How alike a smooth motion is at two places, r over its length apart: exp(−r²/2), or Matérn's of order 5/2, which has
/// two derivatives where the other has all. Of the first what lies between measured points is known too well (Stein
/// 1999, Interpolation of Spatial Data).
enum class Alike { squared_exponential, matern };

/// K ⊗ sizes, (3k × 3k) mm²: the covariance of a smooth motion at the k sites of a response, with these (3 × 3)
/// variances in place of its own; where it fades, multiplied by the shares that are left at the two sites.
Eigen::MatrixXd smooth_covariance(const Response& response, const SmoothMotion& smooth, const Eigen::Matrix3d& sizes,
                                  Alike alike = Alike::squared_exponential);

/// (k) at the sites (k × 3) of an opening: 1 in its middle, a tenth at its rim, by a parabola. The cortex under an
/// opening sinks most in its middle, where the skull beside it supports it least.
Eigen::VectorXd fading_to_rim(const Points& sites);

/// What is believed of displacements before they are measured, at the points of a response: s G of the deformation's
/// energy, weight in mJ, and the smooth motion of the opening, as the body carries it.
class Prior {
 public:
  Prior(const Response& response, double weight, const SmoothMotion& smooth, Alike alike = Alike::squared_exponential);

  /// Covariance, mm², of `rows` components from `first` on with `columns` from `other` on.
  Eigen::MatrixXd between(Eigen::Index first, Eigen::Index rows, Eigen::Index other, Eigen::Index columns) const;

 private:
  const Response& response_;
  double weight_;           // µN mm
  Eigen::MatrixXd smooth_;  // at the sites; empty: none
};

/// Orthonormal columns that span what these do, but for parts that are a fiftieth of the largest: of points that lie
/// so nearly on a line nobody tells how they turn about it.
Eigen::MatrixXd independent(const Eigen::MatrixXd& columns);

/// What was measured, d, as a Gaussian with the covariance V = prior + diag(variance) about a rigid motion that is not
/// known: P = V⁻¹ − V⁻¹ X (Xᵀ V⁻¹ X)⁻¹ Xᵀ V⁻¹.
class MeasuredGaussian {
 public:
  /// prior: (m × m) mm²; rigid: X, (m × 6), independent() or without columns; d: (m) mm; variance: (m) mm².
  MeasuredGaussian(Eigen::MatrixXd prior, Eigen::MatrixXd rigid, const Eigen::VectorXd& d,
                   const Eigen::VectorXd& variance);

  Eigen::VectorXd motion;     ///< the rigid motion, mm
  Eigen::VectorXd push;       ///< P d, 1/mm
  double squares = 0;         ///< dᵀ P d
  double log_likelihood = 0;  ///< restricted: −½ (dᵀ P d + log|V| + log|Xᵀ V⁻¹ X|); −∞ where V is singular

  Eigen::VectorXd motion_deviation() const;

  /// Covariance, mm², of displacements that are not measured: own is their prior, cross that with the measured ones,
  /// their_rigid the rigid motion as it counts there.
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& own, const Eigen::MatrixXd& cross,
                             const Eigen::MatrixXd& their_rigid) const;

  /// P.
  Eigen::MatrixXd precision() const;

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_, normal_;
  Eigen::MatrixXd inverse_rigid_;
};

}  // namespace brainshift::solve
