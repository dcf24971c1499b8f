// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_kernels.hpp"

#include <limits>

namespace brainshift::solve {

namespace {

namespace each_basic {
#define BRAINSHIFT_WIDTH BRAINSHIFT_BASIC_WIDTH
#include "solve/ensemble/each_kernels_body.hpp"
#undef BRAINSHIFT_WIDTH
}  // namespace each_basic

#ifdef BRAINSHIFT_LEVELS
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace each_avx2 {
#define BRAINSHIFT_WIDTH 4
#include "solve/ensemble/each_kernels_body.hpp"
#undef BRAINSHIFT_WIDTH
}  // namespace each_avx2
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx2,fma,avx512f,avx512vl,avx512bw,avx512dq")
namespace each_avx512 {
#define BRAINSHIFT_WIDTH 8
#include "solve/ensemble/each_kernels_body.hpp"
#undef BRAINSHIFT_WIDTH
}  // namespace each_avx512
#pragma GCC pop_options
#endif

// A constant table: no function of a level may run before it is known that the processor can.
#define BRAINSHIFT_EACH_KERNELS(level, name)                                                                        \
  {                                                                                                                 \
    name, {level::gradients<double>, level::spread<double>, level::dilatation<double>, level::neo_hookean<double>}, \
        {level::gradients<float>, level::spread<float>, level::dilatation<float>, level::neo_hookean<float>},       \
        level::pressure                                                                                             \
  }

constexpr EachKernels each_level[] = {
#ifdef BRAINSHIFT_LEVELS
    BRAINSHIFT_EACH_KERNELS(each_avx512, "AVX-512"),
    BRAINSHIFT_EACH_KERNELS(each_avx2, "AVX2"),
#endif
    BRAINSHIFT_EACH_KERNELS(each_basic, "basic"),
};

}  // namespace

std::span<const EachKernels> each_kernels() {
  return std::span(each_level).last(step_kernels().size());
}

}  // namespace brainshift::solve
