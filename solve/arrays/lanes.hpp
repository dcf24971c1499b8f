// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

// Functions with hot loops over lanes are compiled for three levels of the x86-64 instruction set, of which the loader
// picks the best.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__AVX__)
#define BRAINSHIFT_LANES __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define BRAINSHIFT_LANES
#endif
#define BRAINSHIFT_INLINE [[gnu::always_inline]] inline  // takes on the instruction set of its caller
#if defined(__clang__)
#define BRAINSHIFT_UNROLL _Pragma("unroll")
#else
#define BRAINSHIFT_UNROLL _Pragma("GCC unroll 16")
#endif

namespace brainshift::solve {

/// Points that are worked on together.
constexpr int lanes = 8;

/// A number of each of them, and what is true of each: -1, else 0. Aligned as the widest instructions want it, which
/// is not what a compiler for narrower ones does by itself.
using Lane = double __attribute__((vector_size(8 * lanes), aligned(8 * lanes)));
using Mask = std::int64_t __attribute__((vector_size(8 * lanes), aligned(8 * lanes)));

BRAINSHIFT_INLINE bool any(const Mask& mask) {
  std::int64_t some = 0;
  for (int l = 0; l < lanes; ++l) {
    some |= mask[l];
  }
  return some != 0;
}

}  // namespace brainshift::solve
