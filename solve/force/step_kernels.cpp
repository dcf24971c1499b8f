// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/step_kernels.hpp"

#include <algorithm>
#include <limits>

namespace brainshift::solve {

namespace {

namespace basic {
#define BRAINSHIFT_WIDTH BRAINSHIFT_BASIC_WIDTH
#include "solve/force/step_kernels_body.hpp"
#undef BRAINSHIFT_WIDTH
}  // namespace basic

#ifdef BRAINSHIFT_LEVELS
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace avx2 {
#define BRAINSHIFT_WIDTH 4
#include "solve/force/step_kernels_body.hpp"
#undef BRAINSHIFT_WIDTH
}  // namespace avx2
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx2,fma,avx512f,avx512vl,avx512bw,avx512dq")
namespace avx512 {
#define BRAINSHIFT_WIDTH 8
#include "solve/force/step_kernels_body.hpp"
#undef BRAINSHIFT_WIDTH
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

}  // namespace

std::span<const StepKernels> step_kernels() {
  static const std::size_t first = levels_out_of_reach();
  return std::span(all).subspan(first);
}

}  // namespace brainshift::solve
