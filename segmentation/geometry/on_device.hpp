// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What CUDA's compiler is told of code that it translates for the GPU, too; nothing to others.
//   BRAINSHIFT_ON_DEVICE  before a function
//   BRAINSHIFT_APART      before one that is called as a function, so that it takes no registers from who calls it
//   BRAINSHIFT_AHEAD      before a loop whose turns may load before those before them are done
//   BRAINSHIFT_UNROLLED   before a loop of a fixed length
#ifdef __CUDACC__
#define BRAINSHIFT_ON_DEVICE __host__ __device__
#define BRAINSHIFT_APART __noinline__
#define BRAINSHIFT_AHEAD _Pragma("unroll 4")
#define BRAINSHIFT_UNROLLED _Pragma("unroll")
#else
#define BRAINSHIFT_ON_DEVICE
#define BRAINSHIFT_APART
#define BRAINSHIFT_AHEAD
#define BRAINSHIFT_UNROLLED
#endif
