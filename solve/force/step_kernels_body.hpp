// SPDX-License-Identifier: GPL-3.0-or-later
// Included by step_kernels.cpp once for each instruction set, inside a namespace of its own.

#include "solve/force/registers_body.hpp"

/// A node's vector of four, in one register or, where it does not fit, two. Filling a wider one with two or four nodes,
/// by shuffles or insertions, was slower, as they all go through one port of the processor.
template <class Scalar>
constexpr std::size_t node_part = std::min<std::size_t>(4, 8 * width / sizeof(Scalar));
template <class Scalar>
constexpr std::size_t node_parts = 4 / node_part<Scalar>;
template <class Scalar>
struct NodeOf {
  typedef Scalar Part __attribute__((vector_size(node_part<Scalar> * sizeof(Scalar))));
};
template <class Scalar>
using Node = typename NodeOf<Scalar>::Part[node_parts<Scalar>];

template <class Scalar>
BRAINSHIFT_INLINE void load(const Scalar* from, Node<Scalar>& node) {
  BRAINSHIFT_UNROLL
  for (std::size_t i = 0; i < node_parts<Scalar>; ++i) {
    from_memory(from + i * node_part<Scalar>, node[i]);
  }
}

template <class Scalar>
BRAINSHIFT_INLINE void set(Scalar x, Scalar y, Scalar z, Node<Scalar>& node) {
  using Part = typename NodeOf<Scalar>::Part;
  if constexpr (node_parts<Scalar> == 1) {
    node[0] = Part{x, y, z, 0};
  } else {
    node[0] = Part{x, y};
    node[1] = Part{z, 0};
  }
}

template <class Scalar>
BRAINSHIFT_INLINE void store(const Node<Scalar>& node, Scalar* to) {
  BRAINSHIFT_UNROLL
  for (std::size_t i = 0; i < node_parts<Scalar>; ++i) {
    to_memory(node[i], to + i * node_part<Scalar>);
  }
}

template <class Scalar>
BRAINSHIFT_INLINE void add(Node<Scalar>& sum, const Node<Scalar>& node, Scalar factor) {
  BRAINSHIFT_UNROLL
  for (std::size_t i = 0; i < node_parts<Scalar>; ++i) {
    sum[i] += node[i] * factor;
  }
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
      BRAINSHIFT_UNROLL
      for (std::size_t k = 0; k < quad; ++k) {
        Node<Scalar> node;
        load(displacement + 4 * std::size_t{slot[k]}, node);
        BRAINSHIFT_UNROLL
        for (std::size_t axis = 0; axis < 3; ++axis) {
          add(sum[k % 2][axis], node, derivative[3 * k + axis]);
        }
      }
      slot += quad;
      derivative += 3 * quad;
    } while (slot != end);
    const auto i = static_cast<std::size_t>(p - first);
    TensorLanes& out = gradient[i / lanes];
    BRAINSHIFT_UNROLL
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Scalar column[4];
      add(sum[0][axis], sum[1][axis], Scalar{1});
      store(sum[0][axis], column);
      BRAINSHIFT_UNROLL
      for (std::size_t row = 0; row < 3; ++row) {
        out.entry[3 * axis + row][i % lanes] = (row == axis ? 1.0 : 0.0) + static_cast<double>(column[row]);
      }
    }
  }
  for (auto i = static_cast<std::size_t>(last - first); i % lanes != 0; ++i) {
    BRAINSHIFT_UNROLL
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
    BRAINSHIFT_UNROLL
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto entry = [&](std::size_t row) { return static_cast<Scalar>(of.entry[3 * axis + row][i % lanes]); };
      set(entry(0), entry(1), entry(2), column[axis]);
    }
    const std::uint16_t* const end = rows.slot + rows.begin[p + 1];
    do {
      BRAINSHIFT_UNROLL
      for (std::size_t k = 0; k < quad; ++k) {
        Node<Scalar> node;
        load(force + 4 * std::size_t{slot[k]}, node);
        BRAINSHIFT_UNROLL
        for (std::size_t axis = 0; axis < 3; ++axis) {
          add(node, column[axis], derivative[3 * k + axis]);
        }
        store(node, force + 4 * std::size_t{slot[k]});
      }
      slot += quad;
      derivative += 3 * quad;
    } while (slot != end);
  }
}

/// F of as many points as a register holds, the first of them that of the group's.
BRAINSHIFT_INLINE void load(const TensorLanes& group, std::size_t first, Register (&gradient)[9]) {
  BRAINSHIFT_UNROLL
  for (std::size_t k = 0; k < 9; ++k) {
    from_memory(group.entry[k] + first, gradient[k]);
  }
}

void jacobian(const TensorLanes* gradient, std::size_t groups, double* out) {
  for (std::size_t i = 0; i < groups * lanes; i += width) {
    Register f[9], cofactor[9], j;
    load(gradient[i / lanes], i % lanes, f);
    deform(f, cofactor, j);
    to_memory(j, out + i);
  }
}

void neo_hookean(const TensorLanes* gradient, std::size_t groups, double shear_modulus, const double* pressure,
                 const double* volume, TensorLanes* stress) {
  for (std::size_t i = 0; i < groups * lanes; i += width) {
    Register f[9], p, w, s[9];
    load(gradient[i / lanes], i % lanes, f);
    from_memory(pressure + i, p);
    from_memory(volume + i, w);
    neo_hookean_stress(f, Register{} + shear_modulus, p, w, s);
    BRAINSHIFT_UNROLL
    for (std::size_t k = 0; k < 9; ++k) {
      to_memory(s[k], stress[i / lanes].entry[k] + i % lanes);
    }
  }
}
