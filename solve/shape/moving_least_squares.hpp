// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "segmentation/surface/surface.hpp"
#include "solve/shape/shape_options.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

/// Number of monomials up to an order (1 or 2): 4 or 10 in space, 3 or 6 in the plane.
constexpr int monomial_count(int dimensions, int order) {
  return order == 1 ? dimensions + 1 : (dimensions + 1) * (dimensions + 2) / 2;
}

/// The monomials at ξ: 1 x y z √2xy √2xz √2yz x² y² z² (eq 2), in the plane 1 x y √2xy x² y². With the factor √2 a
/// rotation of the frame turns the quadratic ones among themselves, so neither the penalty nor what counts as
/// admissible depends on the frame.
template <int dimensions, int order>
Eigen::Matrix<double, monomial_count(dimensions, order), 1> monomials(const Eigen::Matrix<double, dimensions, 1>& xi) {
  Eigen::Matrix<double, monomial_count(dimensions, order), 1> p;
  p[0] = 1;
  p.template segment<dimensions>(1) = xi;
  if constexpr (order == 2) {
    int next = dimensions + 1;
    for (int j = 0; j < dimensions; ++j) {
      for (int k = j + 1; k < dimensions; ++k) {
        p[next++] = std::numbers::sqrt2 * xi[j] * xi[k];
      }
    }
    p.template tail<dimensions>() = xi.cwiseAbs2();
  }
  return p;
}

/// Quartic spline weight on d = distance / radius ≤ 1 and its derivative by d, divided by d (finite at d = 0).
struct QuarticSpline {
  double value;
  double slope_over_d;
  explicit QuarticSpline(double d) : value(1 + d * d * (-6 + d * (8 - 3 * d))), slope_over_d(-12 + d * (24 - 12 * d)) {}
};

/// One evaluation of (modified) moving least squares at a point, eqs 1-15, in local scaled coordinates ξ = (X_a − x)/r:
/// there p(x) is the first unit vector, and the moment matrix is well conditioned in any unit and at any offset. In the
/// plane (two dimensions) it looks at x and y alone.
template <int dimensions, int order>
class MovingLeastSquares {
  static constexpr int m = monomial_count(dimensions, order);
  static constexpr int linear_terms = monomial_count(dimensions, 1);

 public:
  using Place = Eigen::Matrix<double, dimensions, 1>;
  using Vector = Eigen::Matrix<double, m, 1>;
  using Matrix = Eigen::Matrix<double, m, m>;

  /// Builds the moment matrix at x; false where the support does not determine the basis. penalty: µ of MMLS on the
  /// quadratic coefficients, 0 for plain MLS; leave_to_penalty: accept quadratic terms that only the penalty holds.
  /// distance_gradient: ∂distance/∂x of each supporter where a cut makes it other than straight; else empty.
  bool build(const Eigen::Vector3d& x, std::span<const Supporter> support, const Points& positions,
             std::span<const double> radius, double scale, double penalty, bool leave_to_penalty,
             std::span<const Eigen::Vector3d> distance_gradient = {}) {
    count_ = static_cast<int>(support.size());
    if (count_ < (leave_to_penalty ? linear_terms : m)) {
      return false;
    }
    basis_.resize(m, count_);
    weight_.resize(count_);
    weight_gradient_.resize(dimensions, count_);
    length_ = 0;
    for (const Supporter& s : support) {
      length_ = std::max(length_, scale * radius[static_cast<std::size_t>(s.node)]);
    }
    moment_.setZero();
    double weighted_radii = 0;
    for (int a = 0; a < count_; ++a) {
      const Supporter& s = support[static_cast<std::size_t>(a)];
      const double r = scale * radius[static_cast<std::size_t>(s.node)];
      const Place away = (positions.row(s.node).transpose() - x).template head<dimensions>();
      const QuarticSpline w(s.distance / r);
      basis_.col(a) = monomials<dimensions, order>(away / length_);
      weight_[a] = w.value;
      weighted_radii += w.value * r;
      weight_gradient_.col(a) = -w.slope_over_d / (r * r) * away;
      if (!distance_gradient.empty()) {
        weight_gradient_.col(a) = w.slope_over_d * s.distance / (r * r) *
                                  distance_gradient[static_cast<std::size_t>(a)].template head<dimensions>();
      }
      moment_.template selfadjointView<Eigen::Lower>().rankUpdate(basis_.col(a), w.value);
    }
    return factorise(penalty, leave_to_penalty, weighted_radii / (weight_.sum() * length_));
  }

  /// φ_a(x), into values[0..count).
  void values(std::span<double> phi) {
    coefficients_ = factor_.solve(Vector::Unit(0));
    for (int a = 0; a < count_; ++a) {
      phi[static_cast<std::size_t>(a)] = weight_[a] * coefficients_.dot(basis_.col(a));
    }
  }

  /// ∂φ_a/∂x_J, 1/mm, into gradient[3a + J]; in the plane that by z is 0. Call values() first.
  void gradients(Derivatives kind, std::span<double> gradient) {
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (int axis = 0; axis < dimensions; ++axis) {
      Vector right = Vector::Unit(1 + axis) / length_;
      if (kind == Derivatives::full) {
        for (int a = 0; a < count_; ++a) {
          right -= weight_gradient_(axis, a) * coefficients_.dot(basis_.col(a)) * basis_.col(a);
        }
      }
      const Vector slope = factor_.solve(right);
      for (int a = 0; a < count_; ++a) {
        double g = weight_[a] * slope.dot(basis_.col(a));
        if (kind == Derivatives::full) {
          g += weight_gradient_(axis, a) * coefficients_.dot(basis_.col(a));
        }
        gradient[static_cast<std::size_t>(3 * a + axis)] = g;
      }
    }
  }

 private:
  /// A support is admissible when it determines the basis. Below the quadratic limit the derivatives of quadratic shape
  /// functions grow wild: on a jittered grid up to thirty times the usual; from there on they stay within four times.
  /// The same limits do in the plane, where a moment matrix determines its terms about twice as well. They hold where
  /// all radii are alike; where the mean of the radii is only `reach` of the largest, which scales the coordinates,
  /// second and fourth moments are smaller by its second and fourth power, however far the support is grown.
  bool factorise(double penalty, bool leave_to_penalty, double reach) {
    const double linear_limit = 1e-3 * std::pow(reach, 2), quadratic_limit = 2e-4 * std::pow(reach, 4);
    const double total = weight_.sum();
    if (!(determination<linear_terms, 1>(moment_.template topLeftCorner<linear_terms, linear_terms>() / total) >
          linear_limit)) {
      return false;
    }
    if constexpr (order == 2) {
      if (!leave_to_penalty && !(determination<m, linear_terms>(moment_ / total) > quadratic_limit)) {
        return false;
      }
      moment_.diagonal().template tail<m - linear_terms>().array() += penalty;
    }
    factor_.compute(moment_);
    return factor_.info() == Eigen::Success;
  }

  /// How well a moment matrix of size k determines its terms from `first` on, once those before are known: 1 / tr S⁻¹,
  /// S their Schur complement; at most its least eigenvalue, at least a sixth of it, and the same in every frame. 0
  /// where it does not.
  template <int k, int first>
  static double determination(const Eigen::Matrix<double, k, k>& lower) {
    const Eigen::LLT<Eigen::Matrix<double, k, k>> cholesky(lower);
    if (cholesky.info() != Eigen::Success) {
      return 0;
    }
    constexpr int terms = k - first;
    const Eigen::Matrix<double, terms, terms> root = cholesky.matrixLLT().template bottomRightCorner<terms, terms>();
    const Eigen::Matrix<double, terms, terms> inverse =
        root.template triangularView<Eigen::Lower>().solve(Eigen::Matrix<double, terms, terms>::Identity());
    return 1 / inverse.squaredNorm();
  }

  int count_ = 0;
  double length_ = 0;
  Eigen::Matrix<double, m, Eigen::Dynamic> basis_;
  Eigen::VectorXd weight_;
  Eigen::Matrix<double, dimensions, Eigen::Dynamic> weight_gradient_;
  Matrix moment_;
  Eigen::LLT<Matrix> factor_;
  Vector coefficients_;
};

}  // namespace brainshift::solve
