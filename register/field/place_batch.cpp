// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/place_batch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace brainshift::registration {

namespace {

// Compiled for two levels of the x86-64 instruction set, of which the loader picks the better. Neither fuses products
// and sums: that would gain a tenth, but the field would depend on the machine in its last digits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define BRAINSHIFT_KERNEL __attribute__((target_clones("default", "avx2")))
#else
#define BRAINSHIFT_KERNEL
#endif
#define BRAINSHIFT_INLINE [[gnu::always_inline]] inline  // for a clone to have its own

/// x^a y^b z^c up to a degree, in the order of their degree; each but the first is one before it times x, y or z.
template <int degree>
struct Monomials {
  static constexpr int count = (degree + 1) * (degree + 2) * (degree + 3) / 6;
  std::array<std::array<int, 3>, count> power{};
  std::array<int, count> before{}, axis{};

  constexpr Monomials() {
    int next = 1;
    for (int d = 1; d <= degree; ++d) {
      for (int a = d; a >= 0; --a) {
        for (int b = d - a; b >= 0; --b) {
          const int along = a > 0 ? 0 : b > 0 ? 1 : 2;
          std::array<int, 3> less = {a, b, d - a - b};
          power[next] = less;
          --less[along];
          axis[next] = along;
          before[next++] = place_of(less);
        }
      }
    }
  }

  constexpr int place_of(const std::array<int, 3>& wanted) const {
    return static_cast<int>(std::find(power.begin(), power.end(), wanted) - power.begin());
  }
};

/// The basis of an order; its moments are the monomials up to twice the order.
template <int order>
struct Basis {
  static constexpr int size = Monomials<order>::count;
  static constexpr int moments = Monomials<2 * order>::count;
  static constexpr Monomials<2 * order> monomials{};
  std::array<double, size> factor{};  ///< √2 of a mixed term, as the solver's basis has it
  std::array<std::array<int, size>, size> moment{};

  constexpr Basis() {
    for (int i = 0; i < size; ++i) {
      const auto& p = monomials.power[i];
      factor[i] = p[0] * p[1] + p[0] * p[2] + p[1] * p[2] > 0 ? std::numbers::sqrt2 : 1;
      for (int j = 0; j < size; ++j) {
        const auto& q = monomials.power[j];
        moment[i][j] = monomials.place_of({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
      }
    }
  }
};
template <int order>
constexpr Basis<order> basis{};

/// What the nodes add up to.
template <int order>
struct Sums {
  Lanes moment[Basis<order>::moments] = {};  ///< Σ w ξ^p
  Lanes field[Basis<order>::size][3] = {};   ///< Σ w ξ^p û
  Lanes radii = {};                          ///< Σ w r
  Lanes largest = {};                        ///< largest r of a supporting node
};

BRAINSHIFT_INLINE void take_root(Lanes& value) {
  double plain[batch_size];
  __builtin_memcpy(plain, &value, sizeof value);
  for (double& v : plain) {
    v = std::sqrt(v);
  }
  __builtin_memcpy(&value, plain, sizeof value);
}

/// Radii in units of the batch's length, too.
template <int order>
BRAINSHIFT_INLINE void add_up(const PlaceBatch& batch, Sums<order>& sums) {
  const double scale = 1 / batch.length;
  for (const BatchNode& node : batch.nodes) {
    Lanes xi[3], power[Basis<order>::moments];
    for (int axis = 0; axis < 3; ++axis) {
      xi[axis] = (node.position[axis] - batch.place[axis]) * scale;
    }
    const double radius = node.radius * scale;
    Lanes d = xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2];
    take_root(d);
    d *= 1 / radius;
    const auto sees = d < 1;
    const Lanes spline = 1 + d * d * (-6 + d * (8 - 3 * d));
    power[0] = sees ? spline : Lanes{};
    sums.moment[0] += power[0];
    sums.radii += power[0] * radius;
    const Lanes seen_radius = sees ? Lanes{} + radius : Lanes{};
    sums.largest = sums.largest < seen_radius ? seen_radius : sums.largest;
#pragma GCC unroll 40
    for (int p = 1; p < Basis<order>::moments; ++p) {
      power[p] = power[basis<order>.monomials.before[p]] * xi[basis<order>.monomials.axis[p]];
      sums.moment[p] += power[p];
    }
#pragma GCC unroll 10
    for (int i = 0; i < Basis<order>::size; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        sums.field[i][axis] += power[i] * node.parameter[axis];
      }
    }
  }
}

template <int size>
struct Triangle {
  Lanes at[size][size];  ///< the lower triangle of the root L of the moment matrix
  Lanes inverse_diagonal[size];
};

/// Cholesky's L; not finite where there is none.
template <int order>
BRAINSHIFT_INLINE void factorise(const Sums<order>& sums, const Lanes& penalty, Triangle<Basis<order>::size>& root) {
  constexpr int size = Basis<order>::size;
  for (int j = 0; j < size; ++j) {
    for (int i = j; i < size; ++i) {
      Lanes entry = sums.moment[basis<order>.moment[i][j]] * (basis<order>.factor[i] * basis<order>.factor[j]);
      if (i == j && i >= Monomials<1>::count) {
        entry += penalty;
      }
      for (int k = 0; k < j; ++k) {
        entry -= root.at[i][k] * root.at[j][k];
      }
      if (i == j) {
        take_root(entry);
        root.inverse_diagonal[j] = 1 / entry;
      } else {
        entry *= root.inverse_diagonal[j];
      }
      root.at[i][j] = entry;
    }
  }
}

/// |L⁻¹|² of the diagonal block [first, last) of a lower triangle.
template <int first, int last, int size>
BRAINSHIFT_INLINE void squared_inverse(const Triangle<size>& root, Lanes& sum) {
  sum = Lanes{};
  for (int column = first; column < last; ++column) {
    Lanes inverse[size];
    inverse[column] = root.inverse_diagonal[column];
    sum += inverse[column] * inverse[column];
    for (int i = column + 1; i < last; ++i) {
      Lanes entry = {};
      for (int k = column; k < i; ++k) {
        entry -= root.at[i][k] * inverse[k];
      }
      inverse[i] = entry * root.inverse_diagonal[i];
      sum += inverse[i] * inverse[i];
    }
  }
}

/// c with LLᵀc = (1, 0, ...).
template <int size>
BRAINSHIFT_INLINE void solve_unit(const Triangle<size>& root, Lanes* c) {
  for (int i = 0; i < size; ++i) {
    c[i] = i == 0 ? Lanes{} + 1 : Lanes{};
    for (int k = 0; k < i; ++k) {
      c[i] -= root.at[i][k] * c[k];
    }
    c[i] *= root.inverse_diagonal[i];
  }
  for (int i = size - 1; i >= 0; --i) {
    for (int k = i + 1; k < size; ++k) {
      c[i] -= root.at[k][i] * c[k];
    }
    c[i] *= root.inverse_diagonal[i];
  }
}

/// By the solver's limits (moving_least_squares.hpp), but for a hundredth about them, as the sums differ in the last
/// digits. The penalty, which is in the factor here, must not have made up for what the nodes lack.
template <int order>
BRAINSHIFT_INLINE void judge(const Sums<order>& sums, const Lanes& penalty, const Triangle<Basis<order>::size>& root,
                             Lanes& verdict) {
  constexpr int linear_terms = Monomials<1>::count, size = Basis<order>::size;
  constexpr double more = 1.01, less = 0.99;
  const Lanes& total = sums.moment[0];
  const Lanes reach = sums.radii / total;
  Lanes inverse;
  squared_inverse<1, linear_terms>(root, inverse);
  const Lanes linear = 1 / (total * inverse), linear_limit = 1e-3 * reach * reach;
  auto admissible = linear > more * linear_limit;
  auto inadmissible = linear < less * linear_limit;
  if constexpr (order == 2) {
    squared_inverse<linear_terms, size>(root, inverse);
    const Lanes quadratic = 1 / (total * inverse), limit = 2e-4 * reach * reach * reach * reach;
    admissible &= (quadratic > more * limit) & (quadratic * total > 200 * penalty);
    inadmissible |= quadratic < less * limit;
  }
  verdict = admissible ? Lanes{} + 1 : Lanes{};
  verdict = inadmissible ? Lanes{} - 1 : verdict;
}

template <int order>
BRAINSHIFT_INLINE void interpolate(PlaceBatch& batch) {
  constexpr int size = Basis<order>::size;
  Sums<order> sums;
  add_up(batch, sums);
  const Lanes squared = sums.largest * sums.largest;
  const Lanes penalty = squared * squared * batch.penalty;  // µ counts where the largest radius is the unit
  Triangle<size> root;
  factorise(sums, penalty, root);
  judge(sums, penalty, root, batch.verdict);
  Lanes c[size];
  solve_unit(root, c);
  for (int axis = 0; axis < 3; ++axis) {
    batch.displacement[axis] = Lanes{};
    for (int i = 0; i < size; ++i) {
      batch.displacement[axis] += c[i] * (basis<order>.factor[i] * sums.field[i][axis]);
    }
  }
}

}  // namespace

BRAINSHIFT_KERNEL
void interpolate_linear(PlaceBatch& batch) {
  interpolate<1>(batch);
}

BRAINSHIFT_KERNEL
void interpolate_quadratic(PlaceBatch& batch) {
  interpolate<2>(batch);
}

}  // namespace brainshift::registration
