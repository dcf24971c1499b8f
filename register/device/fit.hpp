// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "register/device/node_bins.hpp"
#include "segmentation/geometry/on_device.hpp"

namespace brainshift::registration::device {

// Moving least squares at one place: what solve/shape/moving_least_squares_body.hpp does at eight, which says why each
// step is as it is, and solve/shape/evaluator.hpp, which grows supports. A test holds the two against each other.

/// How the solution's shape functions were fitted, in space.
struct FitRules {
  int order;       ///< of the basis, 1 or 2
  double penalty;  ///< on the quadratic terms, 0 for plain MLS
};

/// Sums over the nodes that a place sees.
struct Seen {
  int count = 0;
  double total = 0, radii = 0;  ///< Σ w, Σ w r
  double length = 0;            ///< largest r, mm

  BRAINSHIFT_ON_DEVICE void add(double weight, double radius) {
    ++count;
    total += weight;
    radii += weight * radius;
    length = radius > length ? radius : length;
  }
};

BRAINSHIFT_ON_DEVICE inline double quartic_weight(double distance, double radius) {
  const double d = distance * (1 / radius);
  return 1 + d * d * (-6 + d * (8 - 3 * d));
}

/// The nodes that a place sees, looked up once and kept, where they are not too many.
class KeptSupport {
 public:
  static constexpr int most = 96;

  BRAINSHIFT_ON_DEVICE KeptSupport(const NodeView& nodes, const Eigen::Vector3d& x, double scale) : nodes_(nodes) {
    nodes.for_each_seen(x, scale, [this](int node, double distance, double radius) {
      const double weight = quartic_weight(distance, radius);
      if (seen_.count < most) {
        node_[seen_.count] = node;
        weight_[seen_.count] = weight;
      }
      seen_.add(weight, radius);
    });
  }

  BRAINSHIFT_ON_DEVICE const Seen& seen() const { return seen_; }
  BRAINSHIFT_ON_DEVICE bool complete() const { return seen_.count <= most; }
  /// Calls use(node, weight).
  template <class Use>
  BRAINSHIFT_ON_DEVICE void for_each(const Use& use) const {
    for (int n = 0; n < seen_.count; ++n) {
      use(nodes_.node[node_[n]], weight_[n]);
    }
  }

 private:
  const NodeView& nodes_;
  Seen seen_;
  int node_[most];
  double weight_[most];
};

/// The same, looked up each time: any number.
class AnySupport {
 public:
  BRAINSHIFT_ON_DEVICE AnySupport(const NodeView& nodes, const Eigen::Vector3d& x, double scale)
      : nodes_(nodes), x_(x), scale_(scale) {
    nodes.for_each_seen(
        x, scale, [this](int, double distance, double radius) { seen_.add(quartic_weight(distance, radius), radius); });
  }

  BRAINSHIFT_ON_DEVICE const Seen& seen() const { return seen_; }
  template <class Use>
  BRAINSHIFT_ON_DEVICE void for_each(const Use& use) const {
    nodes_.for_each_seen(x_, scale_, [&](int node, double distance, double radius) {
      use(nodes_.node[node], quartic_weight(distance, radius));
    });
  }

 private:
  const NodeView& nodes_;
  const Eigen::Vector3d& x_;
  double scale_;
  Seen seen_;
};

template <int order>
struct Polynomials {
  static constexpr int linear = 4, terms = order == 1 ? 4 : 10;
};

/// 1 x y z √2xy √2xz √2yz x² y² z².
template <int order>
BRAINSHIFT_ON_DEVICE void monomials(const Node& node, const Eigen::Vector3d& x, double inverse_length,
                                    double (&p)[Polynomials<order>::terms]) {
  p[0] = 1;
  BRAINSHIFT_UNROLLED
  for (int j = 0; j < 3; ++j) {
    p[1 + j] = (node.at[j] - x[j]) * inverse_length;
  }
  if constexpr (order == 2) {
    constexpr double root = 1.41421356237309504880;
    p[4] = root * p[1] * p[2];
    p[5] = root * p[1] * p[3];
    p[6] = root * p[2] * p[3];
    p[7] = p[1] * p[1];
    p[8] = p[2] * p[2];
    p[9] = p[3] * p[3];
  }
}

/// L D Lᵀ of the columns from..to in place, 1 / D on the diagonal. False where D is not positive.
template <int from, int to, int m>
BRAINSHIFT_ON_DEVICE bool eliminate(double (&a)[m][m]) {
  bool positive = true;
  BRAINSHIFT_UNROLLED
  for (int k = from; k < to; ++k) {
    positive = positive && a[k][k] > 0;
    a[k][k] = 1 / a[k][k];
    BRAINSHIFT_UNROLLED
    for (int i = m - 1; i > k; --i) {
      const double times = a[i][k] * a[k][k];
      BRAINSHIFT_UNROLLED
      for (int j = k + 1; j <= i; ++j) {
        a[i][j] -= times * a[j][k];
      }
      a[i][k] = times;
    }
  }
  return positive;
}

/// Whether 1 / tr S⁻¹ is above the limit, S the Schur complement of the columns before `from` up to `to`.
template <int from, int to, int m>
BRAINSHIFT_ON_DEVICE bool is_determined(const double (&a)[m][m], double limit) {
  double trace = 0;
  double row[to - from][to - from];  // of L⁻¹
  BRAINSHIFT_UNROLLED
  for (int i = from; i < to; ++i) {
    double squared = 1;
    BRAINSHIFT_UNROLLED
    for (int j = from; j < i; ++j) {
      double sum = -a[i][j];
      BRAINSHIFT_UNROLLED
      for (int k = j + 1; k < i; ++k) {
        sum -= a[i][k] * row[k - from][j - from];
      }
      row[i - from][j - from] = sum;
      squared += sum * sum;
    }
    trace += squared * a[i][i];
  }
  return 1 > limit * trace;
}

/// Whether the quadratic terms of a moment matrix whose linear ones are eliminated are determined without the penalty.
template <int m>
BRAINSHIFT_ON_DEVICE bool are_quadratic_determined(const double (&a)[m][m], double limit) {
  constexpr int linear = 4;
  double plain[m - linear][m - linear];
  BRAINSHIFT_UNROLLED
  for (int i = linear; i < m; ++i) {
    BRAINSHIFT_UNROLLED
    for (int j = linear; j <= i; ++j) {
      plain[i - linear][j - linear] = a[i][j];
    }
  }
  const bool positive = eliminate<0, m - linear>(plain);
  return positive && is_determined<0, m - linear>(plain, limit);
}

/// The moment matrix to L D Lᵀ. False where the support is not admissible.
template <int order, int m>
BRAINSHIFT_ON_DEVICE bool factorise(const Seen& seen, double penalty, bool leave_to_penalty, double (&a)[m][m]) {
  constexpr int linear = Polynomials<order>::linear;
  const double reach = seen.radii / (seen.total * seen.length), squared = reach * reach;
  bool admissible = eliminate<0, linear>(a);
  admissible = admissible && is_determined<1, linear>(a, 1e-3 * squared * seen.total);
  if constexpr (order == 2) {
    if (!leave_to_penalty) {
      admissible = admissible && are_quadratic_determined(a, 2e-4 * squared * squared * seen.total);
    }
    BRAINSHIFT_UNROLLED
    for (int i = linear; i < m; ++i) {
      a[i][i] += penalty;
    }
    admissible = admissible && eliminate<linear, m>(a);
  }
  return admissible;
}

template <int m>
BRAINSHIFT_ON_DEVICE void solve(const double (&a)[m][m], double (&x)[m]) {
  BRAINSHIFT_UNROLLED
  for (int i = 1; i < m; ++i) {
    BRAINSHIFT_UNROLLED
    for (int k = 0; k < i; ++k) {
      x[i] -= a[i][k] * x[k];
    }
  }
  BRAINSHIFT_UNROLLED
  for (int i = m - 1; i >= 0; --i) {
    x[i] *= a[i][i];
    BRAINSHIFT_UNROLLED
    for (int k = i + 1; k < m; ++k) {
      x[i] -= a[k][i] * x[k];
    }
  }
}

/// u(x) = Σ φ_a(x) û_a. False where the support is not admissible.
template <int order, class Support>
BRAINSHIFT_ON_DEVICE bool fit(const Support& support, const Eigen::Vector3d& x, double penalty, bool leave_to_penalty,
                              Eigen::Vector3d& u) {
  constexpr int m = Polynomials<order>::terms;
  const Seen& seen = support.seen();
  if (seen.count < (leave_to_penalty ? Polynomials<order>::linear : m)) {
    return false;
  }
  const double inverse_length = 1 / seen.length;
  double a[m][m] = {};
  support.for_each([&](const Node& node, double weight) {
    double p[m];
    monomials<order>(node, x, inverse_length, p);
    BRAINSHIFT_UNROLLED
    for (int i = 0; i < m; ++i) {
      const double weighted = weight * p[i];
      BRAINSHIFT_UNROLLED
      for (int j = 0; j <= i; ++j) {
        a[i][j] += weighted * p[j];
      }
    }
  });
  if (!factorise<order>(seen, penalty, leave_to_penalty, a)) {
    return false;
  }
  double c[m] = {1};
  solve(a, c);
  double sum[3] = {0, 0, 0};
  support.for_each([&](const Node& node, double weight) {
    double p[m], dot = 0;
    monomials<order>(node, x, inverse_length, p);
    BRAINSHIFT_UNROLLED
    for (int i = 0; i < m; ++i) {
      dot += c[i] * p[i];
    }
    const double value = weight * dot;  // of the shape function
    BRAINSHIFT_UNROLLED
    for (int axis = 0; axis < 3; ++axis) {
      sum[axis] += value * node.value[axis];
    }
  });
  u = Eigen::Vector3d(sum[0], sum[1], sum[2]);
  return true;
}

/// u(x) by one kind of support, grown by a scale.
template <class Support>
BRAINSHIFT_ON_DEVICE bool displacement_by(const Support& support, const FitRules& rules, const Eigen::Vector3d& x,
                                          double scale, Eigen::Vector3d& u) {
  constexpr double patience = 1.5;  // up to this growth MMLS looks for a support that needs no penalty
  const bool leave_to_penalty = rules.penalty > 0 && scale > patience;
  return rules.order == 1 ? fit<1>(support, x, rules.penalty, leave_to_penalty, u)
                          : fit<2>(support, x, rules.penalty, leave_to_penalty, u);
}

/// Most places have an admissible support that is not large. False: of the others.
BRAINSHIFT_ON_DEVICE inline bool displacement_at(const NodeView& nodes, const FitRules& rules, const Eigen::Vector3d& x,
                                                 Eigen::Vector3d& u) {
  const KeptSupport kept(nodes, x, 1);
  return kept.complete() && displacement_by(kept, rules, x, 1, u);
}

/// Any support, grown until it is admissible. False where none is.
BRAINSHIFT_ON_DEVICE inline bool displacement_by_growth(const NodeView& nodes, const FitRules& rules,
                                                        const Eigen::Vector3d& x, Eigen::Vector3d& u) {
  constexpr double growth = 1.1, largest_growth = 8;
  for (double scale = 1; scale < largest_growth; scale *= growth) {
    const KeptSupport kept(nodes, x, scale);
    const bool found = kept.complete() ? displacement_by(kept, rules, x, scale, u)
                                       : displacement_by(AnySupport(nodes, x, scale), rules, x, scale, u);
    if (found) {
      return true;
    }
  }
  return false;
}

}  // namespace brainshift::registration::device
