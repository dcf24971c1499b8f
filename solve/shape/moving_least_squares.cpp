// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/moving_least_squares.hpp"

#include <cmath>
#include <numbers>

namespace brainshift::solve {

namespace {

// Only the functions of the table are compiled for a level, and what is inlined into them: what other files share of
// the libraries must not be.
namespace basic {
#define BRAINSHIFT_WIDTH BRAINSHIFT_BASIC_WIDTH
#define BRAINSHIFT_TARGET
#include "solve/shape/moving_least_squares_body.hpp"
#undef BRAINSHIFT_WIDTH
#undef BRAINSHIFT_TARGET
}  // namespace basic

#ifdef BRAINSHIFT_LEVELS
namespace avx2 {
#define BRAINSHIFT_WIDTH 4
#define BRAINSHIFT_TARGET [[gnu::target("avx2,fma")]]
#include "solve/shape/moving_least_squares_body.hpp"
#undef BRAINSHIFT_WIDTH
#undef BRAINSHIFT_TARGET
}  // namespace avx2

namespace avx512 {
#define BRAINSHIFT_WIDTH 8
#define BRAINSHIFT_TARGET [[gnu::target("avx2,fma,avx512f,avx512vl,avx512bw,avx512dq")]]
#include "solve/shape/moving_least_squares_body.hpp"
#undef BRAINSHIFT_WIDTH
#undef BRAINSHIFT_TARGET
}  // namespace avx512
#endif

constexpr FitKernels all[] = {
#ifdef BRAINSHIFT_LEVELS
    {"AVX-512", avx512::find_neighbours, avx512::fit_shape, avx512::differentiate, avx512::blend},
    {"AVX2", avx2::find_neighbours, avx2::fit_shape, avx2::differentiate, avx2::blend},
#endif
    {"basic", basic::find_neighbours, basic::fit_shape, basic::differentiate, basic::blend},
};

}  // namespace

std::span<const FitKernels> fit_kernels() {
  static const std::size_t first = levels_out_of_reach();
  return std::span(all).subspan(first);
}

std::size_t find_neighbours(const Candidates& candidates, double scale, const PointLanes& places, Neighbour* out) {
  return fit_kernels().front().find(candidates, scale, places, out);
}

void fit_shape(std::span<Neighbour> neighbours, const FitOptions& options, Fit& fit) {
  fit_kernels().front().fit(neighbours, options, fit);
}

void differentiate(std::span<const Neighbour> neighbours, std::span<const DistanceGradient> distance_gradients,
                   const FitOptions& options, Derivatives kind, const Fit& fit, ShapeGradient* out) {
  fit_kernels().front().slopes(neighbours, distance_gradients, options, kind, fit, out);
}

void blend(std::span<const Neighbour> neighbours, const Points& values, Lane (&sum)[3]) {
  fit_kernels().front().mean(neighbours, values, sum);
}

}  // namespace brainshift::solve
