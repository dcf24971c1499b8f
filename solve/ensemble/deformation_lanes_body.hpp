// SPDX-License-Identifier: GPL-3.0-or-later
// Included by sources that are compiled for several instruction sets, once for each, inside a namespace of its own.

/// Deformation, of `lanes` at once.
struct DeformationLanes {
  Lane gradient[9], cofactor[9], jacobian;
};

/// The rest from the gradient.
BRAINSHIFT_INLINE void deform(DeformationLanes& d) {
  for (int column = 0; column < 3; ++column) {
    const Lane* a = d.gradient + 3 * ((column + 1) % 3);
    const Lane* b = d.gradient + 3 * ((column + 2) % 3);
    for (int row = 0; row < 3; ++row) {
      const int next = (row + 1) % 3, last = (row + 2) % 3;
      d.cofactor[3 * column + row] = a[next] * b[last] - a[last] * b[next];
    }
  }
  d.jacobian = d.gradient[0] * d.cofactor[0] + d.gradient[1] * d.cofactor[1] + d.gradient[2] * d.cofactor[2];
}

/// To x^(−1/3) by Newton's method from a start within 5 %; NaN where x is not positive.
BRAINSHIFT_INLINE void refine_inverse_cube_root(const Lane& x, Lane& root) {
  for (int i = 0; i < 4; ++i) {
    root = root * (4.0 - x * root * root * root) * (1.0 / 3);
  }
  const Lane nowhere = Lane{} + std::numeric_limits<double>::quiet_NaN();
  root = x > 0.0 ? root : nowhere;
}

/// volume (P_iso + p ∂J/∂F): NeoHookean::isochoric_stress, µN mm. root: J^(−1/3).
BRAINSHIFT_INLINE void neo_hookean_stress(const DeformationLanes& d, const Lane& root, const Lane& shear_modulus,
                                          const Lane& pressure, const Lane& volume, Lane (&stress)[9]) {
  Lane squared_norm = {};
  for (const Lane& f : d.gradient) {
    squared_norm += f * f;
  }
  const Lane scale = shear_modulus * root * root;
  const Lane of_cofactor = volume * (pressure - scale * squared_norm / (3.0 * d.jacobian));
  const Lane of_gradient = volume * scale;
  for (int k = 0; k < 9; ++k) {
    stress[k] = of_gradient * d.gradient[k] + of_cofactor * d.cofactor[k];
  }
}
