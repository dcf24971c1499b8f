// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/force_scratch.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace brainshift::solve {

Batch::Batch(std::size_t slots, std::size_t points, Precision precision)
    : displacement(slots, precision),
      gradient(groups_of(points)),
      stress(groups_of(points)),
      jacobian(lanes * groups_of(points)),
      dilatation(jacobian),
      pressure(jacobian),
      volume(jacobian) {}

ForceScratch::ForceScratch(const PointBlocks& points, const PointLaws& laws)
    : parameters(4 * points.nodes(), 0.0),
      force(points.slots(), points.precision()),
      block_jacobian(points.blocks.size()) {
  std::int32_t most_points = batch_points, most_slots = 0;
  for (const Patch& patch : points.patches) {
    most_points = std::max(most_points, patch.last_point - patch.first_point);
  }
  for (const Block& block : points.blocks) {
    most_slots = std::max(most_slots, block.slots);
  }
  batches.assign(
      static_cast<std::size_t>(omp_get_max_threads()),
      Batch(static_cast<std::size_t>(most_slots), static_cast<std::size_t>(most_points), points.precision()));
  if (laws.in_time) {
    jacobian.assign(points.points(), 1.0);
  }
  if (laws.plane_stress) {
    thickness.assign(points.points(), 1.0);
  }
  growth.assign(laws.swelling.size(), 1.0);
  if (!laws.prony.empty()) {
    std::size_t size = 0;
    viscous_begin.reserve(points.points());
    for (const Patch& patch : points.patches) {
      const std::size_t terms = laws.prony[static_cast<std::size_t>(patch.material)].terms.size();
      for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
        viscous_begin.push_back(size);
        size += terms > 0 ? viscous_state_size(terms) : 0;
      }
    }
    viscous_state.assign(size, 0.0);
  }
}

void ForceScratch::swell(const PointLaws& laws, double fraction) {
  for (std::size_t row = 0; row < growth.size(); ++row) {
    growth[row] = std::cbrt(1 + fraction * laws.swelling[row]);
  }
}

void ForceScratch::remember(const ForceScratch& other, std::span<const std::int32_t> from) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto k = static_cast<std::size_t>(from[i]);
    if (!jacobian.empty() && !other.jacobian.empty()) {
      jacobian[i] = other.jacobian[k];
    }
    if (!thickness.empty()) {
      thickness[i] = other.thickness[k];
    }
    if (!viscous_begin.empty()) {
      const std::size_t end =
          k + 1 < other.viscous_begin.size() ? other.viscous_begin[k + 1] : other.viscous_state.size();
      std::copy(other.viscous_state.begin() + static_cast<std::ptrdiff_t>(other.viscous_begin[k]),
                other.viscous_state.begin() + static_cast<std::ptrdiff_t>(end),
                viscous_state.begin() + static_cast<std::ptrdiff_t>(viscous_begin[i]));
    }
  }
}

}  // namespace brainshift::solve
