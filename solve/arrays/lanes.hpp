// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

// Hot loops over lanes are compiled for three levels of the x86-64 instruction set: a file ..._body.hpp is included
// once for each, with the number of doubles that its registers hold as BRAINSHIFT_WIDTH. GCC takes longer vectors
// apart, by way of memory.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define BRAINSHIFT_LEVELS
#endif

// Functions with plain loops over the members of an ensemble are left to the compiler, which makes one of each level;
// the loader picks the best.
#if defined(BRAINSHIFT_LEVELS) && !defined(__SANITIZE_ADDRESS__) && !defined(__AVX__)
#define BRAINSHIFT_CLONES __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define BRAINSHIFT_CLONES
#endif

#if defined(BRAINSHIFT_BASIC_WIDTH)  // by the build
#elif defined(__AVX512F__)
#define BRAINSHIFT_BASIC_WIDTH 8
#elif defined(__AVX__)
#define BRAINSHIFT_BASIC_WIDTH 4
#else
#define BRAINSHIFT_BASIC_WIDTH 2
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
/// is not what a compiler for narrower ones does by itself. To be kept; loops reckon with as many as a register holds.
using Lane = double __attribute__((vector_size(8 * lanes), aligned(8 * lanes)));
using Mask = std::int64_t __attribute__((vector_size(8 * lanes), aligned(8 * lanes)));

/// A register in memory, aligned as one of its numbers. Not by way of memcpy, of which Clang makes a call where it
/// checks addresses.
template <class Register, class Number>
struct [[gnu::packed, gnu::aligned(alignof(Number)), gnu::may_alias]] InMemory {
  Register of;
};
template <class Number, class Register>
BRAINSHIFT_INLINE void from_memory(const Number* from, Register& to) {
  to = reinterpret_cast<const InMemory<Register, Number>*>(from)->of;
}
template <class Register, class Number>
BRAINSHIFT_INLINE void to_memory(const Register& from, Number* to) {
  reinterpret_cast<InMemory<Register, Number>*>(to)->of = from;
}

BRAINSHIFT_INLINE bool any(const Mask& mask) {
  std::int64_t some = 0;
  for (int l = 0; l < lanes; ++l) {
    some |= mask[l];
  }
  return some != 0;
}

/// How many of the levels, the fastest first, this processor does not run.
inline std::size_t levels_out_of_reach() {
#ifdef BRAINSHIFT_LEVELS
  const bool fused = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool wide = fused && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
  return wide ? 0 : (fused ? 1 : 2);
#else
  return 0;
#endif
}

}  // namespace brainshift::solve
