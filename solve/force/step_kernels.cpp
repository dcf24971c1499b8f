// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/step_kernels.hpp"

#include <limits>

namespace brainshift::solve {

namespace {

namespace basic {
#include "solve/force/step_kernels_body.hpp"
}  // namespace basic

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define BRAINSHIFT_LEVELS

#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace avx2 {
#include "solve/force/step_kernels_body.hpp"
}  // namespace avx2
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx2,fma,avx512f,avx512vl,avx512bw,avx512dq")
namespace avx512 {
#include "solve/force/step_kernels_body.hpp"
}  // namespace avx512
#pragma GCC pop_options
#endif

// A constant table: no function of a level may run before it is known that the processor can.
#define BRAINSHIFT_KERNELS(level, name)                                                                       \
  {                                                                                                           \
    name, {level::gradients<double>, level::spread<double>}, {level::gradients<float>, level::spread<float>}, \
        level::jacobian, level::neo_hookean                                                                   \
  }

constexpr StepKernels all[] = {
#ifdef BRAINSHIFT_LEVELS
    BRAINSHIFT_KERNELS(avx512, "AVX-512"),
    BRAINSHIFT_KERNELS(avx2, "AVX2"),
#endif
    BRAINSHIFT_KERNELS(basic, "basic"),
};

/// How many of them this processor does not run.
std::size_t out_of_reach() {
#ifdef BRAINSHIFT_LEVELS
  const bool fused = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool wide = fused && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");
  return wide ? 0 : (fused ? 1 : 2);
#else
  return 0;
#endif
}

}  // namespace

std::span<const StepKernels> step_kernels() {
  static const std::size_t first = out_of_reach();
  return std::span(all).subspan(first);
}

}  // namespace brainshift::solve
