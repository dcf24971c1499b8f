// SPDX-License-Identifier: GPL-3.0-or-later
// Included by each_kernels.cpp once for each instruction set, inside a namespace of its own. Members are handled a
// register at a time: nine sums of a point and the derivatives then fit into the registers of every level.

#include "solve/force/registers_body.hpp"

template <class Scalar>
struct RegisterOf {
  typedef Scalar Type __attribute__((vector_size(8 * width)));
  static constexpr std::size_t size = 8 * width / sizeof(Scalar);
};

template <class Scalar>
void gradients(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last,
               const VectorOfEach<Scalar>* displacement, TensorOfEach<Scalar>* gradient) {
  using Part = typename RegisterOf<Scalar>::Type;
  for (std::size_t m = 0; m < members; m += RegisterOf<Scalar>::size) {
    const std::uint16_t* slot = rows.slot + rows.begin[first];
    const Scalar* derivative = rows.derivative + 3 * rows.begin[first];
    for (std::int32_t p = first; p < last; ++p) {
      const std::uint16_t* const end = rows.slot + rows.begin[p + 1];
      Part sum[3][3] = {};
      do {
        __builtin_prefetch(reinterpret_cast<const char*>(derivative) + ahead);
        __builtin_prefetch(reinterpret_cast<const char*>(slot) + ahead / 8);
        BRAINSHIFT_UNROLL
        for (std::size_t k = 0; k < quad; ++k) {
          const VectorOfEach<Scalar>& node = displacement[slot[k]];
          Part u[3];
          BRAINSHIFT_UNROLL
          for (std::size_t row = 0; row < 3; ++row) {
            from_memory(node.of[row] + m, u[row]);
          }
          BRAINSHIFT_UNROLL
          for (std::size_t axis = 0; axis < 3; ++axis) {
            BRAINSHIFT_UNROLL
            for (std::size_t row = 0; row < 3; ++row) {
              sum[axis][row] += u[row] * derivative[3 * k + axis];
            }
          }
        }
        slot += quad;
        derivative += 3 * quad;
      } while (slot != end);
      BRAINSHIFT_UNROLL
      for (std::size_t axis = 0; axis < 3; ++axis) {
        BRAINSHIFT_UNROLL
        for (std::size_t row = 0; row < 3; ++row) {
          to_memory(sum[axis][row], gradient[p - first].entry[3 * axis + row] + m);
        }
      }
    }
  }
}

template <class Scalar>
void spread(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last, const TensorOfEach<Scalar>* stress,
            VectorOfEach<Scalar>* force) {
  using Part = typename RegisterOf<Scalar>::Type;
  for (std::size_t m = 0; m < members; m += RegisterOf<Scalar>::size) {
    const std::uint16_t* slot = rows.slot + rows.begin[first];
    const Scalar* derivative = rows.derivative + 3 * rows.begin[first];
    for (std::int32_t p = first; p < last; ++p) {
      Part column[3][3];
      BRAINSHIFT_UNROLL
      for (std::size_t axis = 0; axis < 3; ++axis) {
        BRAINSHIFT_UNROLL
        for (std::size_t row = 0; row < 3; ++row) {
          from_memory(stress[p - first].entry[3 * axis + row] + m, column[axis][row]);
        }
      }
      const std::uint16_t* const end = rows.slot + rows.begin[p + 1];
      do {
        BRAINSHIFT_UNROLL
        for (std::size_t k = 0; k < quad; ++k) {
          VectorOfEach<Scalar>& node = force[slot[k]];
          BRAINSHIFT_UNROLL
          for (std::size_t row = 0; row < 3; ++row) {
            Part f;
            from_memory(node.of[row] + m, f);
            BRAINSHIFT_UNROLL
            for (std::size_t axis = 0; axis < 3; ++axis) {
              f += column[axis][row] * derivative[3 * k + axis];
            }
            to_memory(f, node.of[row] + m);
          }
        }
        slot += quad;
        derivative += 3 * quad;
      } while (slot != end);
    }
  }
}

BRAINSHIFT_INLINE void widen(const double* from, Register& to) {
  from_memory(from, to);
}

BRAINSHIFT_INLINE void narrow(const Register& from, double* to) {
  to_memory(from, to);
}

typedef float Narrow __attribute__((vector_size(4 * width)));

BRAINSHIFT_INLINE void widen(const float* from, Register& to) {
  Narrow of_members;
  from_memory(from, of_members);
  to = __builtin_convertvector(of_members, Register);
}

BRAINSHIFT_INLINE void narrow(const Register& from, float* to) {
  to_memory(__builtin_convertvector(from, Narrow), to);
}

/// F from H of the members from m on.
template <class Scalar>
BRAINSHIFT_INLINE void widen(const TensorOfEach<Scalar>& tensor, std::size_t m, Register (&gradient)[9]) {
  BRAINSHIFT_UNROLL
  for (std::size_t k = 0; k < 9; ++k) {
    widen(tensor.entry[k] + m, gradient[k]);
    if (k % 4 == 0) {
      gradient[k] += 1.0;
    }
  }
}

template <class Scalar>
void dilatation(const TensorOfEach<Scalar>* gradient, std::size_t points, NumberOfEach<double>* out,
                NumberOfEach<double>& smallest) {
  const Register nowhere = Register{} + std::numeric_limits<double>::quiet_NaN();
  for (std::size_t m = 0; m < members; m += width) {
    Register least;
    widen(smallest.of + m, least);
    for (std::size_t i = 0; i < points; ++i) {
      Register f[9], cofactor[9], j;
      widen(gradient[i], m, f);
      deform(f, cofactor, j);
      const Register theta = j - 1.0;
      least = least <= theta ? least : (theta <= least ? theta : nowhere);
      narrow(theta, out[i].of + m);
    }
    narrow(least, smallest.of + m);
  }
}

template <class Scalar>
void neo_hookean(TensorOfEach<Scalar>* tensor, std::size_t points, const NumberOfEach<double>& shear_modulus,
                 const NumberOfEach<double>* pressure, const double* volume) {
  for (std::size_t m = 0; m < members; m += width) {
    Register shear;
    widen(shear_modulus.of + m, shear);
    for (std::size_t i = 0; i < points; ++i) {
      Register f[9], p, s[9];
      widen(tensor[i], m, f);
      widen(pressure[i].of + m, p);
      neo_hookean_stress(f, shear, p, Register{} + volume[i], s);
      BRAINSHIFT_UNROLL
      for (std::size_t k = 0; k < 9; ++k) {
        narrow(s[k], tensor[i].entry[k] + m);
      }
    }
  }
}

inline void pressure(const double* mode, const double* volume, std::size_t points, const DilatationModuli& moduli,
                     const NumberOfEach<double>* dilatation, NumberOfEach<double>* out) {
  for (std::size_t m = 0; m < members; m += width) {
    Register bulk, unseen;
    widen(moduli.seen.of + m, bulk);
    widen(moduli.unseen.of + m, unseen);
    Register seen[4] = {};
    for (std::size_t i = 0; i < points && mode != nullptr; ++i) {
      Register theta;
      widen(dilatation[i].of + m, theta);
      BRAINSHIFT_UNROLL
      for (std::size_t k = 0; k < 4; ++k) {
        seen[k] += volume[i] * mode[4 * i + k] * theta;
      }
    }
    for (std::size_t i = 0; i < points; ++i) {
      Register theta;
      widen(dilatation[i].of + m, theta);
      Register projected = theta;
      if (mode != nullptr) {
        const double* psi = mode + 4 * i;
        projected = seen[0] * psi[0] + seen[1] * psi[1] + seen[2] * psi[2] + seen[3] * psi[3];
      }
      narrow(bulk * projected + unseen * (theta - projected), out[i].of + m);
    }
  }
}
