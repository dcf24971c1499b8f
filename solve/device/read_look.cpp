// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/read_look.hpp"

#include <algorithm>
#include <numeric>

#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/dynamics/span_bound.hpp"

namespace brainshift::solve::device {

double left_by_spans(const LookSums& look) {
  const auto& of = look.of;
  return std::max(of[LookSums::span_of_nodes], SpanBound::of_all(of[LookSums::span_longest], of[LookSums::span_product],
                                                                 of[LookSums::span_squares]));
}

PointState point_state(const LookSums& look, std::span<const double> volume) {
  const auto& of = look.of;
  PointState state;
  state.strain_energy = of[LookSums::strain_energy];
  state.smallest_jacobian = -of[LookSums::minus_jacobian];
  state.largest_stretch = of[LookSums::stretch];
  state.compressed_share = of[LookSums::compressed] / std::accumulate(volume.begin(), volume.end(), 0.0);
  for (std::size_t row = 0; row < volume.size(); ++row) {
    const double pressed = of[static_cast<std::size_t>(LookSums::pressed) + row];
    state.pressed_share = std::max(state.pressed_share, volume[row] > 0 ? pressed / volume[row] : 0.0);
  }
  return state;
}

double lowest_eigenvalue(const LookSums& look, bool of_window) {
  const auto& of = look.of;
  const double of_step = rayleigh_quotient(of[LookSums::stiffness], of[LookSums::inertia_before]);
  return of_window ? std::min(of_step, rayleigh_quotient(of[LookSums::window_stiffness], of[LookSums::window_inertia]))
                   : of_step;
}

}  // namespace brainshift::solve::device
