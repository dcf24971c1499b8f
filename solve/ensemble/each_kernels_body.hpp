// SPDX-License-Identifier: GPL-3.0-or-later
// Included by each_kernels.cpp once for each instruction set, inside a namespace of its own that has the width of its
// registers in bytes. Members are handled a register at a time: nine sums of a point and the derivatives then fit into
// the registers of every level.

#include "solve/ensemble/deformation_lanes_body.hpp"

/// How far ahead derivatives are fetched.
constexpr std::size_t ahead = 4096;  // bytes

template <class Scalar>
struct RegisterOf {
  typedef Scalar Type __attribute__((vector_size(width)));
  static constexpr std::size_t size = width / sizeof(Scalar);
};

template <class Vector, class Scalar>
BRAINSHIFT_INLINE void load(const Scalar* from, Vector& to) {
  __builtin_memcpy(&to, from, sizeof to);
}

template <class Scalar>
void gradients(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last,
               const VectorOfEach<Scalar>* displacement, TensorOfEach<Scalar>* gradient) {
  using Register = typename RegisterOf<Scalar>::Type;
  for (std::size_t m = 0; m < members; m += RegisterOf<Scalar>::size) {
    const std::uint16_t* slot = rows.slot + rows.begin[first];
    const Scalar* derivative = rows.derivative + 3 * rows.begin[first];
    for (std::int32_t p = first; p < last; ++p) {
      const std::uint16_t* const end = rows.slot + rows.begin[p + 1];
      Register sum[3][3] = {};
      do {
        __builtin_prefetch(reinterpret_cast<const char*>(derivative) + ahead);
        __builtin_prefetch(reinterpret_cast<const char*>(slot) + ahead / 8);
#pragma GCC unroll 4
        for (std::size_t k = 0; k < quad; ++k) {
          const VectorOfEach<Scalar>& node = displacement[slot[k]];
          Register u[3];
          for (std::size_t row = 0; row < 3; ++row) {
            load(node.of[row] + m, u[row]);
          }
          for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t row = 0; row < 3; ++row) {
              sum[axis][row] += u[row] * derivative[3 * k + axis];
            }
          }
        }
        slot += quad;
        derivative += 3 * quad;
      } while (slot != end);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t row = 0; row < 3; ++row) {
          __builtin_memcpy(gradient[p - first].entry[3 * axis + row] + m, &sum[axis][row], sizeof(Register));
        }
      }
    }
  }
}

template <class Scalar>
void spread(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last, const TensorOfEach<Scalar>* stress,
            VectorOfEach<Scalar>* force) {
  using Register = typename RegisterOf<Scalar>::Type;
  for (std::size_t m = 0; m < members; m += RegisterOf<Scalar>::size) {
    const std::uint16_t* slot = rows.slot + rows.begin[first];
    const Scalar* derivative = rows.derivative + 3 * rows.begin[first];
    for (std::int32_t p = first; p < last; ++p) {
      Register column[3][3];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t row = 0; row < 3; ++row) {
          load(stress[p - first].entry[3 * axis + row] + m, column[axis][row]);
        }
      }
      const std::uint16_t* const end = rows.slot + rows.begin[p + 1];
      do {
#pragma GCC unroll 4
        for (std::size_t k = 0; k < quad; ++k) {
          VectorOfEach<Scalar>& node = force[slot[k]];
          for (std::size_t row = 0; row < 3; ++row) {
            Register f;
            load(node.of[row] + m, f);
            for (std::size_t axis = 0; axis < 3; ++axis) {
              f += column[axis][row] * derivative[3 * k + axis];
            }
            __builtin_memcpy(node.of[row] + m, &f, sizeof f);
          }
        }
        slot += quad;
        derivative += 3 * quad;
      } while (slot != end);
    }
  }
}

BRAINSHIFT_INLINE void widen(const double* from, Lane& to) {
  __builtin_memcpy(&to, from, sizeof to);
}

BRAINSHIFT_INLINE void widen(const float* from, Lane& to) {
  typedef float Narrow __attribute__((vector_size(4 * lanes)));
  typedef double Wide __attribute__((vector_size(8 * lanes)));
  Narrow narrow;
  __builtin_memcpy(&narrow, from, sizeof narrow);
  to = __builtin_convertvector(narrow, Wide);
}

BRAINSHIFT_INLINE void narrow(const Lane& from, double* to) {
  __builtin_memcpy(to, &from, sizeof from);
}

BRAINSHIFT_INLINE void narrow(const Lane& from, float* to) {
  typedef float Narrow __attribute__((vector_size(4 * lanes)));
  typedef double Wide __attribute__((vector_size(8 * lanes)));
  const Wide wide = from;
  const Narrow rounded = __builtin_convertvector(wide, Narrow);
  __builtin_memcpy(to, &rounded, sizeof rounded);
}

/// F from H, and what follows from it, of the members from m on.
template <class Scalar>
BRAINSHIFT_INLINE void deform_members(const TensorOfEach<Scalar>& gradient, std::size_t m, DeformationLanes& d) {
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) {
    widen(gradient.entry[k] + m, d.gradient[k]);
    if (k % 4 == 0) {
      d.gradient[k] += 1.0;
    }
  }
  deform(d);
}

template <class Scalar>
void dilatation(const TensorOfEach<Scalar>* gradient, std::size_t points, NumberOfEach<double>* out,
                NumberOfEach<double>& smallest) {
  const Lane nowhere = Lane{} + std::numeric_limits<double>::quiet_NaN();
  for (std::size_t m = 0; m < members; m += members_at_once) {
    Lane least;
    widen(smallest.of + m, least);
    for (std::size_t i = 0; i < points; ++i) {
      DeformationLanes d;
      deform_members(gradient[i], m, d);
      const Lane theta = d.jacobian - 1.0;
      least = least <= theta ? least : (theta <= least ? theta : nowhere);
      narrow(theta, out[i].of + m);
    }
    narrow(least, smallest.of + m);
  }
}

/// x^(−1/3). The start divides the upper half of the bits by three, which all levels can do in registers.
BRAINSHIFT_INLINE void inverse_cube_root(const Lane& x, Lane& root) {
  typedef std::uint64_t Bits __attribute__((vector_size(8 * lanes)));
  Bits bits;
  __builtin_memcpy(&bits, &x, sizeof bits);
  bits = (0x553ef0ff - ((bits >> 32) * 0x55555556 >> 32)) << 32;
  __builtin_memcpy(&root, &bits, sizeof root);
  refine_inverse_cube_root(x, root);
}

template <class Scalar>
void neo_hookean(TensorOfEach<Scalar>* tensor, std::size_t points, const NumberOfEach<double>& shear_modulus,
                 const NumberOfEach<double>* pressure, const double* volume) {
  for (std::size_t m = 0; m < members; m += members_at_once) {
    Lane shear;
    widen(shear_modulus.of + m, shear);
    for (std::size_t i = 0; i < points; ++i) {
      DeformationLanes d;
      deform_members(tensor[i], m, d);
      Lane p, root, stress[9];
      widen(pressure[i].of + m, p);
      inverse_cube_root(d.jacobian, root);
      neo_hookean_stress(d, root, shear, p, Lane{} + volume[i], stress);
#pragma GCC unroll 9
      for (int k = 0; k < 9; ++k) {
        narrow(stress[k], tensor[i].entry[k] + m);
      }
    }
  }
}

inline void pressure(const double* mode, const double* volume, std::size_t points, const DilatationModuli& moduli,
                     const NumberOfEach<double>* dilatation, NumberOfEach<double>* out) {
  for (std::size_t m = 0; m < members; m += members_at_once) {
    Lane bulk, unseen;
    widen(moduli.seen.of + m, bulk);
    widen(moduli.unseen.of + m, unseen);
    Lane seen[4] = {};
    for (std::size_t i = 0; i < points && mode != nullptr; ++i) {
      Lane theta;
      widen(dilatation[i].of + m, theta);
      for (std::size_t k = 0; k < 4; ++k) {
        seen[k] += volume[i] * mode[4 * i + k] * theta;
      }
    }
    for (std::size_t i = 0; i < points; ++i) {
      Lane theta;
      widen(dilatation[i].of + m, theta);
      Lane projected = theta;
      if (mode != nullptr) {
        const double* psi = mode + 4 * i;
        projected = seen[0] * psi[0] + seen[1] * psi[1] + seen[2] * psi[2] + seen[3] * psi[3];
      }
      narrow(bulk * projected + unseen * (theta - projected), out[i].of + m);
    }
  }
}
