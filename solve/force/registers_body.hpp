// SPDX-License-Identifier: GPL-3.0-or-later
// Included by sources that are compiled for several instruction sets, once for each, inside a namespace of its own.

/// Doubles that a register holds. GCC takes longer vectors apart, by way of memory.
constexpr std::size_t width = BRAINSHIFT_WIDTH;
typedef double Register __attribute__((vector_size(8 * width)));
typedef std::uint64_t Bits __attribute__((vector_size(8 * width)));

/// How far ahead derivatives are fetched: each is read once a step, and the processor foresees too little of it.
constexpr std::size_t ahead = 4096;  // bytes

/// ∂J/∂F and J from F, at as many points as a register holds.
BRAINSHIFT_INLINE void deform(const Register (&gradient)[9], Register (&cofactor)[9], Register& jacobian) {
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

/// volume (P_iso + p ∂J/∂F) there: NeoHookean::isochoric_stress, µN mm.
BRAINSHIFT_INLINE void neo_hookean_stress(const Register (&gradient)[9], const Register& shear_modulus,
                                          const Register& pressure, const Register& volume, Register (&stress)[9]) {
  Register cofactor[9], jacobian, root, squared_norm = {};
  deform(gradient, cofactor, jacobian);
  inverse_cube_root(jacobian, root);
  BRAINSHIFT_UNROLL
  for (std::size_t k = 0; k < 9; ++k) {
    squared_norm += gradient[k] * gradient[k];
  }
  const Register scale = shear_modulus * root * root;
  const Register of_cofactor = volume * (pressure - scale * squared_norm / (3.0 * jacobian));
  const Register of_gradient = volume * scale;
  BRAINSHIFT_UNROLL
  for (std::size_t k = 0; k < 9; ++k) {
    stress[k] = of_gradient * gradient[k] + of_cofactor * cofactor[k];
  }
}
