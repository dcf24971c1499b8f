// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/moving_least_squares.hpp"

#include <cmath>
#include <numbers>

namespace brainshift::solve {

namespace {

/// The monomials at ξ: 1 x y z √2xy √2xz √2yz x² y² z² (Wittek et al., eq. 2), in the plane 1 x y √2xy x² y². With the
/// factor √2 a rotation of the frame turns the quadratic ones among themselves, so neither the penalty nor what counts
/// as admissible depends on the frame.
template <int dimensions, int order>
BRAINSHIFT_INLINE void monomials(const Neighbour& s, const Lane& inverse_length,
                                 Lane (&p)[monomial_count(dimensions, order)]) {
  p[0] = Lane{} + 1;
  BRAINSHIFT_UNROLL
  for (int j = 0; j < dimensions; ++j) {
    p[1 + j] = s.away[j] * inverse_length;
  }
  if constexpr (order == 2) {
    int next = dimensions + 1;
    BRAINSHIFT_UNROLL
    for (int j = 0; j < dimensions; ++j) {
      BRAINSHIFT_UNROLL
      for (int k = j + 1; k < dimensions; ++k) {
        p[next++] = std::numbers::sqrt2 * p[1 + j] * p[1 + k];
      }
    }
    BRAINSHIFT_UNROLL
    for (int j = 0; j < dimensions; ++j) {
      p[next++] = p[1 + j] * p[1 + j];
    }
  }
}

struct WeightSums {
  Lane total{}, radii{};  ///< Σ w, Σ w r
  Mask count{};
};

/// 0 where the mask is: spares the compiler a choice, which it makes lane by lane.
BRAINSHIFT_INLINE void zero_outside(const Mask& mask, Lane& lane) {
  lane = (Lane)((Mask)lane & mask);
}

/// Quartic spline weights 1 − 6d² + 8d³ − 3d⁴ on d = distance / radius, and the largest radius.
BRAINSHIFT_INLINE WeightSums weigh_neighbours(std::span<Neighbour> neighbours, Lane& length) {
  WeightSums sum;
  length = Lane{};
  for (Neighbour& s : neighbours) {
    const Mask seen = s.distance < s.radius;
    const Lane d = s.distance * (1 / s.radius);
    s.weight = 1 + d * d * (-6 + d * (8 - 3 * d));
    s.weight_slope = (-12 + d * (24 - 12 * d)) * (1 / (s.radius * s.radius));
    zero_outside(seen, s.weight);
    zero_outside(seen, s.weight_slope);
    Lane longer = s.radius - length;
    zero_outside(seen & (longer > 0), longer);
    length += longer;
    sum.total += s.weight;
    sum.radii += s.weight * s.radius;
    sum.count -= seen;
  }
  return sum;
}

/// L D Lᵀ of the columns from..to of the moment matrix, in place; what remains below and to the right is their Schur
/// complement. Not admissible where D is not positive.
template <int from, int to, int m>
BRAINSHIFT_INLINE void eliminate(Fit& fit) {
  auto& a = fit.factor;
  BRAINSHIFT_UNROLL
  for (int k = from; k < to; ++k) {
    fit.admissible &= a[k][k] > 0;
    a[k][k] = 1 / a[k][k];
    BRAINSHIFT_UNROLL
    for (int i = m - 1; i > k; --i) {  // from below: rows above still hold what they were
      const Lane factor = a[i][k] * a[k][k];
      BRAINSHIFT_UNROLL
      for (int j = k + 1; j <= i; ++j) {
        a[i][j] -= factor * a[j][k];
      }
      a[i][k] = factor;
    }
  }
}

/// Not admissible where 1 / tr S⁻¹ is not above the limit, S the Schur complement of the columns before `from` in the
/// leading ones up to `to`.
template <int from, int to>
BRAINSHIFT_INLINE void need_determination(const Lane& limit, Fit& fit) {
  const auto& a = fit.factor;
  Lane trace{};
  Lane row[to][to];  // of L⁻¹
  BRAINSHIFT_UNROLL
  for (int i = from; i < to; ++i) {
    Lane squared = Lane{} + 1;
    BRAINSHIFT_UNROLL
    for (int j = from; j < i; ++j) {
      row[i][j] = -a[i][j];
      BRAINSHIFT_UNROLL
      for (int k = j + 1; k < i; ++k) {
        row[i][j] -= a[i][k] * row[k][j];
      }
      squared += row[i][j] * row[i][j];
    }
    trace += squared * a[i][i];
  }
  fit.admissible &= 1 > limit * trace;
}

template <int m>
BRAINSHIFT_INLINE void solve(const Lane (&a)[Fit::most][Fit::most], Lane (&x)[m]) {
  BRAINSHIFT_UNROLL
  for (int i = 1; i < m; ++i) {
    BRAINSHIFT_UNROLL
    for (int k = 0; k < i; ++k) {
      x[i] -= a[i][k] * x[k];
    }
  }
  BRAINSHIFT_UNROLL
  for (int i = m - 1; i >= 0; --i) {
    x[i] *= a[i][i];
    BRAINSHIFT_UNROLL
    for (int k = i + 1; k < m; ++k) {
      x[i] -= a[k][i] * x[k];
    }
  }
}

/// A support is admissible when it determines the basis: its moment matrix (over Σ w) determines the terms of each
/// order once those before are known. By how much: 1 / tr S⁻¹, S their Schur complement; at most its least eigenvalue,
/// at least a sixth of it, and the same in every frame. Below the quadratic limit the derivatives of quadratic shape
/// functions grow wild: on a jittered grid up to thirty times the usual; from there on they stay within four times.
/// The same limits do in the plane, where a moment matrix determines its terms about twice as well. They hold where
/// all radii are alike; where the mean of the radii is only `reach` of the largest, which scales the coordinates,
/// second and fourth moments are smaller by its second and fourth power, however far the support is grown.
template <int dimensions, int order>
BRAINSHIFT_INLINE void factorise(const FitOptions& options, const Lane& total, const Lane& reach, Fit& fit) {
  constexpr int m = monomial_count(dimensions, order), linear = monomial_count(dimensions, 1);
  const Lane squared = reach * reach;
  eliminate<0, linear, m>(fit);
  need_determination<1, linear>(1e-3 * squared * total, fit);
  if constexpr (order == 2) {
    if (!options.leave_to_penalty) {
      Fit plain = fit;
      eliminate<linear, m, m>(plain);
      need_determination<linear, m>(2e-4 * squared * squared * total, plain);
      fit.admissible = plain.admissible;
    }
    BRAINSHIFT_UNROLL
    for (int i = linear; i < m; ++i) {
      fit.factor[i][i] += options.penalty;
    }
    eliminate<linear, m, m>(fit);
  }
}

/// Rows from..to of the moment matrix: few enough at a time that the sums stay in registers.
template <int dimensions, int order, int from, int to>
BRAINSHIFT_INLINE void add_up_moments(std::span<const Neighbour> neighbours, const Lane& inverse_length, Fit& fit) {
  Lane sum[to - from][to] = {}, p[monomial_count(dimensions, order)];
  for (const Neighbour& s : neighbours) {
    monomials<dimensions, order>(s, inverse_length, p);
    BRAINSHIFT_UNROLL
    for (int i = from; i < to; ++i) {
      const Lane weighted = s.weight * p[i];
      BRAINSHIFT_UNROLL
      for (int j = 0; j <= i; ++j) {
        sum[i - from][j] += weighted * p[j];
      }
    }
  }
  BRAINSHIFT_UNROLL
  for (int i = from; i < to; ++i) {
    BRAINSHIFT_UNROLL
    for (int j = 0; j <= i; ++j) {
      fit.factor[i][j] = sum[i - from][j];
    }
  }
}

template <int dimensions, int order>
BRAINSHIFT_INLINE void fit_as(std::span<Neighbour> neighbours, const FitOptions& options, Fit& fit) {
  constexpr int m = monomial_count(dimensions, order);
  const WeightSums sum = weigh_neighbours(neighbours, fit.length);
  const Lane inverse_length = 1 / fit.length;
  if constexpr (m == 10) {
    add_up_moments<dimensions, order, 0, 6>(neighbours, inverse_length, fit);
    add_up_moments<dimensions, order, 6, 8>(neighbours, inverse_length, fit);
    add_up_moments<dimensions, order, 8, 10>(neighbours, inverse_length, fit);
  } else {
    add_up_moments<dimensions, order, 0, m>(neighbours, inverse_length, fit);
  }
  Lane p[m];
  fit.count = sum.count;
  const int least = options.leave_to_penalty ? monomial_count(dimensions, 1) : m;
  fit.admissible = sum.count >= least;
  factorise<dimensions, order>(options, sum.total, sum.radii / (sum.total * fit.length), fit);
  Lane c[m] = {Lane{} + 1};
  solve<m>(fit.factor, c);
  BRAINSHIFT_UNROLL
  for (int i = 0; i < m; ++i) {
    fit.coefficient[i] = c[i];
  }
  for (Neighbour& s : neighbours) {
    monomials<dimensions, order>(s, inverse_length, p);
    Lane dot{};
    BRAINSHIFT_UNROLL
    for (int i = 0; i < m; ++i) {
      dot += c[i] * p[i];
    }
    s.value = s.weight * dot;
  }
}

template <int dimensions, int order>
BRAINSHIFT_INLINE void differentiate_as(std::span<const Neighbour> neighbours,
                                        std::span<const DistanceGradient> distance_gradients, Derivatives kind,
                                        const Fit& fit, ShapeGradient* out) {
  constexpr int m = monomial_count(dimensions, order);
  const Lane inverse_length = 1 / fit.length;
  Lane right[dimensions][m] = {}, p[m];
  BRAINSHIFT_UNROLL
  for (int axis = 0; axis < dimensions; ++axis) {
    right[axis][1 + axis] = inverse_length;
  }
  for (std::size_t a = 0; a < neighbours.size(); ++a) {
    for (Lane& axis : out[a].axis) {
      axis = Lane{};
    }
    if (kind == Derivatives::diffuse) {
      continue;
    }
    const Neighbour& s = neighbours[a];
    monomials<dimensions, order>(s, inverse_length, p);
    Lane dot{};
    BRAINSHIFT_UNROLL
    for (int i = 0; i < m; ++i) {
      dot += fit.coefficient[i] * p[i];
    }
    const Lane* pull = distance_gradients.empty() ? s.away : distance_gradients[a].axis;
    BRAINSHIFT_UNROLL
    for (int axis = 0; axis < dimensions; ++axis) {
      const Lane slope = -s.weight_slope * pull[axis] * dot;  // of the weight alone
      out[a].axis[axis] = slope;
      BRAINSHIFT_UNROLL
      for (int i = 0; i < m; ++i) {
        right[axis][i] -= slope * p[i];
      }
    }
  }
  BRAINSHIFT_UNROLL
  for (int axis = 0; axis < dimensions; ++axis) {
    solve<m>(fit.factor, right[axis]);
  }
  for (std::size_t a = 0; a < neighbours.size(); ++a) {
    monomials<dimensions, order>(neighbours[a], inverse_length, p);
    BRAINSHIFT_UNROLL
    for (int axis = 0; axis < dimensions; ++axis) {
      Lane dot{};
      BRAINSHIFT_UNROLL
      for (int i = 0; i < m; ++i) {
        dot += right[axis][i] * p[i];
      }
      out[a].axis[axis] += neighbours[a].weight * dot;
    }
  }
}

}  // namespace

BRAINSHIFT_LANES
std::size_t find_neighbours(const Candidates& candidates, double scale, const PointLanes& places, Neighbour* out) {
  const auto& [centre, extent] = places.ball;
  std::size_t count = 0;
  for (std::size_t c = 0; c < candidates.node.size(); ++c) {
    const double x = candidates.x[c] - centre.x(), y = candidates.y[c] - centre.y(), z = candidates.z[c] - centre.z();
    const double radius = scale * candidates.radius[c], reach = radius + extent;
    if (x * x + y * y + z * z >= reach * reach) {
      continue;
    }
    Neighbour& s = out[count];  // overwritten by the next where no place sees it
    s.node = candidates.node[c];
    s.radius = radius;
    s.away[0] = candidates.x[c] - places.at[0];
    s.away[1] = candidates.y[c] - places.at[1];
    s.away[2] = candidates.z[c] - places.at[2];
    Lane distance = s.away[0] * s.away[0] + s.away[1] * s.away[1] + s.away[2] * s.away[2];
    for (int l = 0; l < lanes; ++l) {
      distance[l] = std::sqrt(distance[l]);
    }
    s.distance = distance + places.unwanted;
    count += any(s.distance < radius) ? 1 : 0;
  }
  return count;
}

BRAINSHIFT_LANES
void fit_shape(std::span<Neighbour> neighbours, const FitOptions& options, Fit& fit) {
  if (options.dimensions == 2) {
    options.order == 1 ? fit_as<2, 1>(neighbours, options, fit) : fit_as<2, 2>(neighbours, options, fit);
  } else {
    options.order == 1 ? fit_as<3, 1>(neighbours, options, fit) : fit_as<3, 2>(neighbours, options, fit);
  }
}

BRAINSHIFT_LANES
void differentiate(std::span<const Neighbour> neighbours, std::span<const DistanceGradient> distance_gradients,
                   const FitOptions& options, Derivatives kind, const Fit& fit, ShapeGradient* out) {
  if (options.dimensions == 2) {
    options.order == 1 ? differentiate_as<2, 1>(neighbours, distance_gradients, kind, fit, out)
                       : differentiate_as<2, 2>(neighbours, distance_gradients, kind, fit, out);
  } else {
    options.order == 1 ? differentiate_as<3, 1>(neighbours, distance_gradients, kind, fit, out)
                       : differentiate_as<3, 2>(neighbours, distance_gradients, kind, fit, out);
  }
}

BRAINSHIFT_LANES
void blend(std::span<const Neighbour> neighbours, const Points& values, Lane (&sum)[3]) {
  for (Lane& s : sum) {
    s = Lane{};
  }
  for (const Neighbour& s : neighbours) {
    const double* value = values.data() + 3 * s.node;
    BRAINSHIFT_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      sum[axis] += s.value * value[axis];
    }
  }
}

}  // namespace brainshift::solve
