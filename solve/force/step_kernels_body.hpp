// SPDX-License-Identifier: GPL-3.0-or-later
// Included by step_kernels.cpp once for each instruction set, inside a namespace of its own.

/// Doubles that a register holds. GCC takes longer vectors apart, by way of memory.
constexpr std::size_t width = BRAINSHIFT_WIDTH;
typedef double Register __attribute__((vector_size(8 * width)));
typedef std::uint64_t Bits __attribute__((vector_size(8 * width)));

/// How far ahead derivatives are fetched: each is read once a step, and the processor foresees too little of it.
constexpr std::size_t ahead = 4096;  // bytes

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
    __builtin_memcpy(&node[i], from + i * node_part<Scalar>, sizeof node[i]);
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
    __builtin_memcpy(to + i * node_part<Scalar>, &node[i], sizeof node[i]);
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
#pragma GCC unroll 4
      for (std::size_t k = 0; k < quad; ++k) {
        Node<Scalar> node;
        load(displacement + 4 * std::size_t{slot[k]}, node);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          add(sum[k % 2][axis], node, derivative[3 * k + axis]);
        }
      }
      slot += quad;
      derivative += 3 * quad;
    } while (slot != end);
    const auto i = static_cast<std::size_t>(p - first);
    TensorLanes& out = gradient[i / lanes];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Scalar column[4];
      add(sum[0][axis], sum[1][axis], Scalar{1});
      store(sum[0][axis], column);
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
      const auto entry = [&](std::size_t row) { return static_cast<Scalar>(of.entry[3 * axis + row][i % lanes]); };
      set(entry(0), entry(1), entry(2), column[axis]);
    }
    const std::uint16_t* const end = rows.slot + rows.begin[p + 1];
    do {
#pragma GCC unroll 4
      for (std::size_t k = 0; k < quad; ++k) {
        Node<Scalar> node;
        load(force + 4 * std::size_t{slot[k]}, node);
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

/// Deformation of as many points as a register holds, the first of them that of the group's.
BRAINSHIFT_INLINE void deform(const TensorLanes& group, std::size_t first, Register (&gradient)[9],
                              Register (&cofactor)[9], Register& jacobian) {
  BRAINSHIFT_UNROLL
  for (std::size_t k = 0; k < 9; ++k) {
    __builtin_memcpy(&gradient[k], group.entry[k] + first, sizeof gradient[k]);
  }
  BRAINSHIFT_UNROLL
  for (std::size_t column = 0; column < 3; ++column) {
    const Register* a = gradient + 3 * ((column + 1) % 3);
    const Register* b = gradient + 3 * ((column + 2) % 3);
    BRAINSHIFT_UNROLL
    for (std::size_t row = 0; row < 3; ++row) {
      const std::size_t next = (row + 1) % 3, last = (row + 2) % 3;
      cofactor[3 * column + row] = a[next] * b[last] - a[last] * b[next];
    }
  }
  jacobian = gradient[0] * cofactor[0] + gradient[1] * cofactor[1] + gradient[2] * cofactor[2];
}

/// n / 3 rounded down, n < 2^34. Registers do not divide whole numbers, but a double holds them: beside 1.5 · 2^52,
/// about which doubles lie 1 apart, its last bits are they.
BRAINSHIFT_INLINE void third(const Bits& n, Bits& quotient) {
  constexpr double large = 0x1.8p52;
  const Bits large_bits = (Bits)(Register{} + large);
  const Register x = (Register)(n | large_bits) - large;
  quotient = (Bits)((x - 1) * (1.0 / 3) + large) ^ large_bits;
}

/// x^(−1/3) by Newton's method; NaN where x is not positive. The start, from the bits of x, is within 5 %.
BRAINSHIFT_INLINE void inverse_cube_root(const Register& x, Register& root) {
  const Bits bits = (Bits)x, high = bits >> 32;
  Bits high_third, low_third;
  third(high, high_third);
  third(bits - (high_third << 32) - (high_third << 33), low_third);
  root = (Register)(0x553ef0ff289dd796 - (high_third << 32) - low_third);
  BRAINSHIFT_UNROLL
  for (int i = 0; i < 4; ++i) {
    root = root * (4.0 - x * root * root * root) * (1.0 / 3);
  }
  const Register nowhere = Register{} + std::numeric_limits<double>::quiet_NaN();
  root = x > 0.0 ? root : nowhere;
}

void jacobian(const TensorLanes* gradient, std::size_t groups, double* out) {
  for (std::size_t i = 0; i < groups * lanes; i += width) {
    Register f[9], cofactor[9], j;
    deform(gradient[i / lanes], i % lanes, f, cofactor, j);
    __builtin_memcpy(out + i, &j, sizeof j);
  }
}

void neo_hookean(const TensorLanes* gradient, std::size_t groups, double shear_modulus, const double* pressure,
                 const double* volume, TensorLanes* stress) {
  for (std::size_t i = 0; i < groups * lanes; i += width) {
    Register f[9], cofactor[9], j, root, p, w, squared_norm = {};
    deform(gradient[i / lanes], i % lanes, f, cofactor, j);
    inverse_cube_root(j, root);
    __builtin_memcpy(&p, pressure + i, sizeof p);
    __builtin_memcpy(&w, volume + i, sizeof w);
    BRAINSHIFT_UNROLL
    for (std::size_t k = 0; k < 9; ++k) {
      squared_norm += f[k] * f[k];
    }
    const Register scale = shear_modulus * root * root;
    const Register of_cofactor = w * (p - scale * squared_norm / (3.0 * j)), of_gradient = w * scale;
    BRAINSHIFT_UNROLL
    for (std::size_t k = 0; k < 9; ++k) {
      const Register entry = of_gradient * f[k] + of_cofactor * cofactor[k];
      __builtin_memcpy(stress[i / lanes].entry[k] + i % lanes, &entry, sizeof entry);
    }
  }
}
