// SPDX-License-Identifier: GPL-3.0-or-later
// Included by moving_least_squares.cpp once for each instruction set, inside a namespace of its own. The eight points
// are taken in parts, by as many as a register holds; `first` is the lane of a part's first point.

/// Doubles that a register holds. GCC takes longer vectors apart, by way of memory.
constexpr int width = BRAINSHIFT_WIDTH;
typedef double Register __attribute__((vector_size(8 * width)));
typedef std::int64_t Truth __attribute__((vector_size(8 * width)));

BRAINSHIFT_INLINE void load(const Lane& lane, int first, Register& part) {
  from_memory(reinterpret_cast<const double*>(&lane) + first, part);
}
BRAINSHIFT_INLINE void store(const Register& part, int first, Lane& lane) {
  to_memory(part, reinterpret_cast<double*>(&lane) + first);
}
BRAINSHIFT_INLINE void store(const Truth& part, int first, Mask& mask) {
  to_memory(part, reinterpret_cast<std::int64_t*>(&mask) + first);
}

/// The monomials at ξ: 1 x y z √2xy √2xz √2yz x² y² z² (Wittek et al., eq. 2), in the plane 1 x y √2xy x² y². With the
/// factor √2 a rotation of the frame turns the quadratic ones among themselves, so neither the penalty nor what counts
/// as admissible depends on the frame.
template <int dimensions, int order>
BRAINSHIFT_INLINE void monomials(const Neighbour& s, int first, const Register& inverse_length,
                                 Register (&p)[monomial_count(dimensions, order)]) {
  p[0] = Register{} + 1;
  BRAINSHIFT_UNROLL
  for (int j = 0; j < dimensions; ++j) {
    load(s.away[j], first, p[1 + j]);
    p[1 + j] *= inverse_length;
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
  Register total{}, radii{};  ///< Σ w, Σ w r
  Register length{};          ///< largest r
  Truth count{};
};

/// 0 where it is not true: spares the compiler a choice, which it makes lane by lane.
BRAINSHIFT_INLINE void zero_outside(const Truth& inside, Register& part) {
  part = (Register)((Truth)part & inside);
}

/// Quartic spline weights 1 − 6d² + 8d³ − 3d⁴ on d = distance / radius, and the largest radius.
BRAINSHIFT_INLINE void weigh_neighbours(std::span<Neighbour> neighbours, int first, WeightSums& sum) {
  for (Neighbour& s : neighbours) {
    Register distance;
    load(s.distance, first, distance);
    const Truth seen = distance < s.radius;
    const Register d = distance * (1 / s.radius);
    Register weight = 1 + d * d * (-6 + d * (8 - 3 * d));
    Register slope = (-12 + d * (24 - 12 * d)) * (1 / (s.radius * s.radius));
    zero_outside(seen, weight);
    zero_outside(seen, slope);
    Register longer = s.radius - sum.length;
    zero_outside(seen & (longer > 0), longer);
    sum.length += longer;
    sum.total += weight;
    sum.radii += weight * s.radius;
    sum.count -= seen;
    store(weight, first, s.weight);
    store(slope, first, s.weight_slope);
  }
}

/// Of a part: the moment matrix M, then its L D Lᵀ as Fit has it.
struct Factor {
  Register a[Fit::most][Fit::most];
  Truth admissible;
};

/// L D Lᵀ of the columns from..to of the moment matrix, in place; what remains below and to the right is their Schur
/// complement. Not admissible where D is not positive.
template <int from, int to, int m>
BRAINSHIFT_INLINE void eliminate(Factor& factor) {
  auto& a = factor.a;
  BRAINSHIFT_UNROLL
  for (int k = from; k < to; ++k) {
    factor.admissible &= a[k][k] > 0;
    a[k][k] = 1 / a[k][k];
    BRAINSHIFT_UNROLL
    for (int i = m - 1; i > k; --i) {  // from below: rows above still hold what they were
      const Register times = a[i][k] * a[k][k];
      BRAINSHIFT_UNROLL
      for (int j = k + 1; j <= i; ++j) {
        a[i][j] -= times * a[j][k];
      }
      a[i][k] = times;
    }
  }
}

/// Not admissible where 1 / tr S⁻¹ is not above the limit, S the Schur complement of the columns before `from` in the
/// leading ones up to `to`.
template <int from, int to>
BRAINSHIFT_INLINE void need_determination(const Register& limit, Factor& factor) {
  const auto& a = factor.a;
  Register trace{};
  Register row[to][to];  // of L⁻¹
  BRAINSHIFT_UNROLL
  for (int i = from; i < to; ++i) {
    Register squared = Register{} + 1;
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
  factor.admissible &= 1 > limit * trace;
}

template <int m>
BRAINSHIFT_INLINE void solve(const Register (&a)[Fit::most][Fit::most], Register (&x)[m]) {
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
BRAINSHIFT_INLINE void factorise(const FitOptions& options, const Register& total, const Register& reach,
                                 Factor& factor) {
  constexpr int m = monomial_count(dimensions, order), linear = monomial_count(dimensions, 1);
  const Register squared = reach * reach;
  eliminate<0, linear, m>(factor);
  need_determination<1, linear>(1e-3 * squared * total, factor);
  if constexpr (order == 2) {
    if (!options.leave_to_penalty) {
      Factor plain = factor;
      eliminate<linear, m, m>(plain);
      need_determination<linear, m>(2e-4 * squared * squared * total, plain);
      factor.admissible = plain.admissible;
    }
    BRAINSHIFT_UNROLL
    for (int i = linear; i < m; ++i) {
      factor.a[i][i] += options.penalty;
    }
    eliminate<linear, m, m>(factor);
  }
}

/// Rows from..to of the moment matrix: few enough at a time that the sums stay in registers.
template <int dimensions, int order, int from, int to>
BRAINSHIFT_INLINE void add_up_moments(std::span<const Neighbour> neighbours, int first, const Register& inverse_length,
                                      Factor& factor) {
  Register sum[to - from][to] = {}, p[monomial_count(dimensions, order)], weight;
  for (const Neighbour& s : neighbours) {
    monomials<dimensions, order>(s, first, inverse_length, p);
    load(s.weight, first, weight);
    BRAINSHIFT_UNROLL
    for (int i = from; i < to; ++i) {
      const Register weighted = weight * p[i];
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
      factor.a[i][j] = sum[i - from][j];
    }
  }
}

template <int dimensions, int order>
BRAINSHIFT_INLINE void fit_part(std::span<Neighbour> neighbours, const FitOptions& options, int first, Fit& fit) {
  constexpr int m = monomial_count(dimensions, order);
  WeightSums sum;
  weigh_neighbours(neighbours, first, sum);
  const Register inverse_length = 1 / sum.length;
  Factor factor;
  if constexpr (m == 10) {
    add_up_moments<dimensions, order, 0, 6>(neighbours, first, inverse_length, factor);
    add_up_moments<dimensions, order, 6, 8>(neighbours, first, inverse_length, factor);
    add_up_moments<dimensions, order, 8, 10>(neighbours, first, inverse_length, factor);
  } else {
    add_up_moments<dimensions, order, 0, m>(neighbours, first, inverse_length, factor);
  }
  const std::int64_t least = options.leave_to_penalty ? monomial_count(dimensions, 1) : m;
  factor.admissible = sum.count >= least;
  factorise<dimensions, order>(options, sum.total, sum.radii / (sum.total * sum.length), factor);
  Register c[m] = {Register{} + 1}, p[m];
  solve<m>(factor.a, c);
  for (Neighbour& s : neighbours) {
    monomials<dimensions, order>(s, first, inverse_length, p);
    Register dot{}, weight;
    BRAINSHIFT_UNROLL
    for (int i = 0; i < m; ++i) {
      dot += c[i] * p[i];
    }
    load(s.weight, first, weight);
    store(weight * dot, first, s.value);
  }
  store(factor.admissible, first, fit.admissible);
  store(sum.count, first, fit.count);
  store(sum.length, first, fit.length);
  BRAINSHIFT_UNROLL
  for (int i = 0; i < m; ++i) {
    store(c[i], first, fit.coefficient[i]);
    BRAINSHIFT_UNROLL
    for (int j = 0; j <= i; ++j) {
      store(factor.a[i][j], first, fit.factor[i][j]);
    }
  }
}

template <int dimensions, int order>
BRAINSHIFT_INLINE void differentiate_part(std::span<const Neighbour> neighbours,
                                          std::span<const DistanceGradient> distance_gradients, Derivatives kind,
                                          const Fit& fit, int first, ShapeGradient* out) {
  constexpr int m = monomial_count(dimensions, order);
  Register length, c[m], a[Fit::most][Fit::most];
  load(fit.length, first, length);
  BRAINSHIFT_UNROLL
  for (int i = 0; i < m; ++i) {
    load(fit.coefficient[i], first, c[i]);
  }
  const Register inverse_length = 1 / length;
  Register right[dimensions][m] = {}, p[m];
  BRAINSHIFT_UNROLL
  for (int axis = 0; axis < dimensions; ++axis) {
    right[axis][1 + axis] = inverse_length;
  }
  for (std::size_t n = 0; n < neighbours.size(); ++n) {
    for (Lane& axis : out[n].axis) {
      store(Register{}, first, axis);
    }
    if (kind == Derivatives::diffuse) {
      continue;
    }
    const Neighbour& s = neighbours[n];
    monomials<dimensions, order>(s, first, inverse_length, p);
    Register dot{}, weight_slope;
    BRAINSHIFT_UNROLL
    for (int i = 0; i < m; ++i) {
      dot += c[i] * p[i];
    }
    load(s.weight_slope, first, weight_slope);
    const Lane* pull = distance_gradients.empty() ? s.away : distance_gradients[n].axis;
    BRAINSHIFT_UNROLL
    for (int axis = 0; axis < dimensions; ++axis) {
      Register along;
      load(pull[axis], first, along);
      const Register slope = -weight_slope * along * dot;  // of the weight alone
      store(slope, first, out[n].axis[axis]);
      BRAINSHIFT_UNROLL
      for (int i = 0; i < m; ++i) {
        right[axis][i] -= slope * p[i];
      }
    }
  }
  BRAINSHIFT_UNROLL
  for (int i = 0; i < m; ++i) {
    BRAINSHIFT_UNROLL
    for (int j = 0; j <= i; ++j) {
      load(fit.factor[i][j], first, a[i][j]);
    }
  }
  BRAINSHIFT_UNROLL
  for (int axis = 0; axis < dimensions; ++axis) {
    solve<m>(a, right[axis]);
  }
  for (std::size_t n = 0; n < neighbours.size(); ++n) {
    monomials<dimensions, order>(neighbours[n], first, inverse_length, p);
    Register weight;
    load(neighbours[n].weight, first, weight);
    BRAINSHIFT_UNROLL
    for (int axis = 0; axis < dimensions; ++axis) {
      Register dot{}, gradient;
      BRAINSHIFT_UNROLL
      for (int i = 0; i < m; ++i) {
        dot += right[axis][i] * p[i];
      }
      load(out[n].axis[axis], first, gradient);
      store(gradient + weight * dot, first, out[n].axis[axis]);
    }
  }
}

template <int dimensions, int order>
BRAINSHIFT_INLINE void fit_as(std::span<Neighbour> neighbours, const FitOptions& options, Fit& fit) {
  for (int first = 0; first < lanes; first += width) {
    fit_part<dimensions, order>(neighbours, options, first, fit);
  }
}

template <int dimensions, int order>
BRAINSHIFT_INLINE void differentiate_as(std::span<const Neighbour> neighbours,
                                        std::span<const DistanceGradient> distance_gradients, Derivatives kind,
                                        const Fit& fit, ShapeGradient* out) {
  for (int first = 0; first < lanes; first += width) {
    differentiate_part<dimensions, order>(neighbours, distance_gradients, kind, fit, first, out);
  }
}

/// Whether one of a part's places sees the node.
BRAINSHIFT_INLINE bool see(const PointLanes& places, int first, Neighbour& s) {
  Register x, y, z, unwanted;
  load(s.away[0], first, x);
  load(s.away[1], first, y);
  load(s.away[2], first, z);
  load(places.unwanted, first, unwanted);
  Register distance = x * x + y * y + z * z;
  for (int l = 0; l < width; ++l) {
    distance[l] = std::sqrt(distance[l]);
  }
  distance += unwanted;
  store(distance, first, s.distance);
  const Truth inside = distance < s.radius;
  std::int64_t some = 0;
  for (int l = 0; l < width; ++l) {
    some |= inside[l];
  }
  return some != 0;
}

BRAINSHIFT_TARGET
std::size_t find_neighbours(const Candidates& candidates, double scale, const PointLanes& places, Neighbour* out) {
  const auto& [centre, extent] = places.ball;
  std::size_t count = 0;
  for (std::size_t c = 0; c < candidates.node.size(); ++c) {
    const double at[3] = {candidates.x[c], candidates.y[c], candidates.z[c]};
    const double x = at[0] - centre.x(), y = at[1] - centre.y(), z = at[2] - centre.z();
    const double radius = scale * candidates.radius[c], reach = radius + extent;
    if (x * x + y * y + z * z >= reach * reach) {
      continue;
    }
    Neighbour& s = out[count];  // overwritten by the next where no place sees it
    s.node = candidates.node[c];
    s.radius = radius;
    bool seen = false;
    for (int first = 0; first < lanes; first += width) {
      BRAINSHIFT_UNROLL
      for (int axis = 0; axis < 3; ++axis) {
        Register place;
        load(places.at[axis], first, place);
        store(at[axis] - place, first, s.away[axis]);
      }
      seen |= see(places, first, s);
    }
    count += seen ? 1 : 0;
  }
  return count;
}

BRAINSHIFT_TARGET
void fit_shape(std::span<Neighbour> neighbours, const FitOptions& options, Fit& fit) {
  if (options.dimensions == 2) {
    options.order == 1 ? fit_as<2, 1>(neighbours, options, fit) : fit_as<2, 2>(neighbours, options, fit);
  } else {
    options.order == 1 ? fit_as<3, 1>(neighbours, options, fit) : fit_as<3, 2>(neighbours, options, fit);
  }
}

BRAINSHIFT_TARGET
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

BRAINSHIFT_TARGET
void blend(std::span<const Neighbour> neighbours, const Points& values, Lane (&sum)[3]) {
  for (int first = 0; first < lanes; first += width) {
    Register part[3] = {}, weight;
    for (const Neighbour& s : neighbours) {
      const double* value = values.data() + 3 * s.node;
      load(s.value, first, weight);
      BRAINSHIFT_UNROLL
      for (int axis = 0; axis < 3; ++axis) {
        part[axis] += weight * value[axis];
      }
    }
    BRAINSHIFT_UNROLL
    for (int axis = 0; axis < 3; ++axis) {
      store(part[axis], first, sum[axis]);
    }
  }
}
