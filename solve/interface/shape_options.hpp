// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace brainshift {

enum class Basis : std::uint8_t {
  linear,              ///< MLS, 1 x y z
  quadratic,           ///< MLS, all ten (planar: six) monomials up to order two; singular on some clouds
  modified_quadratic,  ///< MMLS: quadratic, its six (three) highest coefficients held by a small penalty, METHOD.md (3)
};

enum class Derivatives : std::uint8_t {
  full,     ///< of p M⁻¹ Pᵀ W as a whole
  diffuse,  ///< of the basis alone: ∂M⁻¹ and ∂W dropped, cheaper and inexact
};

struct ShapeOptions {
  Basis basis = Basis::modified_quadratic;
  Derivatives derivatives = Derivatives::full;
  /// Support radius / local spacing; 0: 1.6 for the linear basis, 2.2 for the quadratic ones; planar 1.8 and 2.4, which
  /// see 10 to 13 and 17 to 22 nodes.
  double dilatation = 0;
  double penalty = 1e-7;  ///< κ of MMLS, in scaled coordinates
  bool planar = false;    ///< basis of x and y alone, for clouds with z = 0
};

}  // namespace brainshift
