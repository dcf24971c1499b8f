// SPDX-License-Identifier: GPL-3.0-or-later
// Included by step_kernels.cpp once for each instruction set, inside a namespace of its own.

#include "solve/force/deformation_lanes_body.hpp"

/// How far ahead derivatives are fetched: each is read once a step, and the processor foresees too little of it.
constexpr std::size_t ahead = 4096;  // bytes

/// A node's vector of four. One fills half a register or a quarter: filling it with two or four nodes, by shuffles or
/// insertions, was slower, as they all go through one port of the processor.
template <class Scalar>
struct NodeOf {
  typedef Scalar Type __attribute__((vector_size(4 * sizeof(Scalar))));
};
template <class Scalar>
using Node = typename NodeOf<Scalar>::Type;

template <class Scalar>
BRAINSHIFT_INLINE void load(const Scalar* values, std::uint16_t slot, Node<Scalar>& node) {
  __builtin_memcpy(&node, values + 4 * std::size_t{slot}, sizeof node);
}

template <class Scalar>
void gradients(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last, const Scalar* displacement,
               TensorLanes* gradient) {
  const std::uint16_t* slot = rows.slot + rows.begin[first];
  const Scalar* derivative = rows.derivative + 3 * rows.begin[first];
  for (std::int32_t p = first; p < last; ++p) {
    const std::uint16_t* const end = rows.slot + rows.begin[p + 1];
    Node<Scalar> sum[2][3] = {};  // two, so that an addition need not wait for the one before
    do {
      __builtin_prefetch(reinterpret_cast<const char*>(derivative) + ahead);
      __builtin_prefetch(reinterpret_cast<const char*>(slot) + ahead / 8);
#pragma GCC unroll 4
      for (std::size_t k = 0; k < quad; ++k) {
        Node<Scalar> node;
        load(displacement, slot[k], node);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          sum[k % 2][axis] += node * derivative[3 * k + axis];
        }
      }
      slot += quad;
      derivative += 3 * quad;
    } while (slot != end);
    const auto i = static_cast<std::size_t>(p - first);
    TensorLanes& out = gradient[i / lanes];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Node<Scalar> column = sum[0][axis] + sum[1][axis];
      for (std::size_t row = 0; row < 3; ++row) {
        out.entry[3 * axis + row][i % lanes] = (row == axis ? 1.0 : 0.0) + static_cast<double>(column[row]);
      }
    }
  }
  for (auto i = static_cast<std::size_t>(last - first); i % lanes != 0; ++i) {
    for (std::size_t k = 0; k < 9; ++k) {
      gradient[i / lanes].entry[k][i % lanes] = k % 4 == 0 ? 1.0 : 0.0;
    }
  }
}

template <class Scalar>
void spread(const PairRows<Scalar>& rows, std::int32_t first, std::int32_t last, const TensorLanes* stress,
            Scalar* force) {
  const std::uint16_t* slot = rows.slot + rows.begin[first];
  const Scalar* derivative = rows.derivative + 3 * rows.begin[first];
  for (std::int32_t p = first; p < last; ++p) {
    const auto i = static_cast<std::size_t>(p - first);
    const TensorLanes& of = stress[i / lanes];
    Node<Scalar> column[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      column[axis] = Node<Scalar>{static_cast<Scalar>(of.entry[3 * axis][i % lanes]),
                                  static_cast<Scalar>(of.entry[3 * axis + 1][i % lanes]),
                                  static_cast<Scalar>(of.entry[3 * axis + 2][i % lanes]), 0};
    }
    const std::uint16_t* const end = rows.slot + rows.begin[p + 1];
    do {
#pragma GCC unroll 4
      for (std::size_t k = 0; k < quad; ++k) {
        Node<Scalar> node;
        load(force, slot[k], node);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          node += column[axis] * derivative[3 * k + axis];
        }
        __builtin_memcpy(force + 4 * std::size_t{slot[k]}, &node, sizeof node);
      }
      slot += quad;
      derivative += 3 * quad;
    } while (slot != end);
  }
}

/// Of the gradient at `lanes` points.
BRAINSHIFT_INLINE void deform(const TensorLanes& gradient, DeformationLanes& d) {
  __builtin_memcpy(d.gradient, gradient.entry, sizeof d.gradient);
  deform(d);
}

/// x^(−1/3). The start is from the bits of x.
BRAINSHIFT_INLINE void inverse_cube_root(const Lane& x, Lane& root) {
  std::uint64_t bits[lanes];
  __builtin_memcpy(bits, &x, sizeof bits);
  for (std::uint64_t& b : bits) {
    b = 0x553ef0ff289dd796 - b / 3;
  }
  __builtin_memcpy(&root, bits, sizeof root);
  refine_inverse_cube_root(x, root);
}

void jacobian(const TensorLanes* gradient, std::size_t groups, double* out) {
  for (std::size_t g = 0; g < groups; ++g) {
    DeformationLanes d;
    deform(gradient[g], d);
    __builtin_memcpy(out + lanes * g, &d.jacobian, sizeof d.jacobian);
  }
}

void neo_hookean(const TensorLanes* gradient, std::size_t groups, double shear_modulus, const double* pressure,
                 const double* volume, TensorLanes* stress) {
  for (std::size_t g = 0; g < groups; ++g) {
    DeformationLanes d;
    deform(gradient[g], d);
    Lane root, p, w, of_group[9];
    inverse_cube_root(d.jacobian, root);
    __builtin_memcpy(&p, pressure + lanes * g, sizeof p);
    __builtin_memcpy(&w, volume + lanes * g, sizeof w);
    neo_hookean_stress(d, root, Lane{} + shear_modulus, p, w, of_group);
    for (int k = 0; k < 9; ++k) {
      __builtin_memcpy(stress[g].entry[k], &of_group[k], sizeof of_group[k]);
    }
  }
}
