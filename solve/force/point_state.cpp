// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "solve/arrays/shared_work.hpp"
#include "solve/force/internal_force.hpp"
#include "solve/force/patch_dilatation.hpp"
#include "solve/interface/result.hpp"
#include "solve/material/principal.hpp"

namespace brainshift::solve {

namespace {

/// Of a block. Volumes by the row of the material, mm³.
struct BlockState {
  PointState state = {};
  std::vector<double> volume, pressed;
};

template <class ElasticLaw>
void add_patch(const PointBlocks& points, const Patch& patch, const ElasticLaw& law, const ForceScratch& scratch,
               BlockState& block) {
  PointState& state = block.state;
  const auto row = static_cast<std::size_t>(patch.material);
  const std::vector<Eigen::Matrix3d> gradients = gradients_of(points, patch, scratch);
  const Eigen::Vector4d dilatations = projected_dilatation(points, patch, law, gradients);
  const double growth = scratch.growth_of(patch.material), volume_at_rest = growth * growth * growth;
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const Deformation d(gradients[static_cast<std::size_t>(p - patch.first_point)]);
    const double seen = dilatations.dot(points.modes_of(p));
    const double volumetric = point_energy(law, seen, law.dilatation(d));
    const double volume = points.volume[static_cast<std::size_t>(p)];
    state.strain_energy += volume * volume_at_rest * (law.isochoric_energy(d) + volumetric);
    state.smallest_jacobian = lesser(state.smallest_jacobian, volume_at_rest * d.jacobian);
    const Eigen::Vector3d elastic_stretches = principal_stretches(d.gradient);
    state.largest_stretch = std::max(state.largest_stretch, growth * elastic_stretches.maxCoeff());
    state.compressed_share += elastic_stretches.minCoeff() < crease_stretch ? volume : 0;
    block.volume[row] += volume;
    block.pressed[row] += law.bulk_modulus * std::abs(seen) > most_pressure * law.shear_modulus ? volume : 0;
  }
}

}  // namespace

PointState point_state(const PointBlocks& points, const PointLaws& laws, const ForceScratch& scratch) {
  const std::vector<double> none(laws.elastic.size(), 0.0);
  std::vector<BlockState> partial(points.blocks.size(), {.volume = none, .pressed = none});
  const auto blocks = static_cast<std::int64_t>(points.blocks.size());
  share_work(blocks, 1, [&](std::int64_t b) {
    const auto i = static_cast<std::size_t>(b);
    for (std::int32_t k = points.blocks[i].first_patch; k < points.blocks[i].last_patch; ++k) {
      const Patch& patch = points.patches[static_cast<std::size_t>(k)];
      std::visit([&](const auto& law) { add_patch(points, patch, law, scratch, partial[i]); },
                 laws.elastic[static_cast<std::size_t>(patch.material)]);
    }
  });
  PointState state;
  std::vector<double> of_tissue = none, pressed = none;
  for (const auto& [part, part_of_tissue, part_pressed] : partial) {
    state.strain_energy += part.strain_energy;
    state.smallest_jacobian = lesser(state.smallest_jacobian, part.smallest_jacobian);
    state.largest_stretch = std::max(state.largest_stretch, part.largest_stretch);
    state.compressed_share += part.compressed_share;
    for (std::size_t row = 0; row < none.size(); ++row) {
      of_tissue[row] += part_of_tissue[row];
      pressed[row] += part_pressed[row];
    }
  }
  state.compressed_share /= std::accumulate(points.volume.begin(), points.volume.end(), 0.0);
  for (std::size_t row = 0; row < none.size(); ++row) {
    state.pressed_share = std::max(state.pressed_share, of_tissue[row] > 0 ? pressed[row] / of_tissue[row] : 0.0);
  }
  return state;
}

}  // namespace brainshift::solve
