// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_force.hpp"

#include <omp.h>

#include <algorithm>

#include "solve/arrays/shared_work.hpp"
#include "solve/force/force_scratch.hpp"
#include "solve/force/patch_dilatation.hpp"

namespace brainshift::solve {

namespace {

std::vector<LawOfEach> laws_of_each(std::span<const PointLaws> laws) {
  std::vector<LawOfEach> rows(laws.front().elastic.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    LawOfEach& each = rows[row];
    for (std::size_t m = 0; m < members; ++m) {
      const ElasticLaw& law = laws[m < laws.size() ? m : 0].elastic[row];
      each.law.push_back(law);
      each.neo_hookean = each.neo_hookean && std::holds_alternative<NeoHookean>(law);
      std::visit(
          [&](const auto& one) {
            each.shear_modulus.of[m] = one.shear_modulus;
            each.moduli.seen.of[m] = one.bulk_modulus;
            each.moduli.unseen.of[m] = unprojected_modulus(one);
          },
          law);
    }
  }
  return rows;
}

/// Patches from the first that are worked on at once: several only where each is a single point.
std::size_t patches_at_once(std::span<const Patch> patches, bool shared_pressure) {
  std::size_t length = 1;
  while (!shared_pressure && length < patches.size() && length < static_cast<std::size_t>(batch_points) &&
         patches[length].material == patches[0].material) {
    ++length;
  }
  return length;
}

std::size_t points_of(std::span<const Patch> patches) {
  return static_cast<std::size_t>(patches.back().last_point - patches.front().first_point);
}

/// Stress times volume of laws that are not handled in registers, in the place of H.
template <class Scalar>
void find_stress(const LawOfEach& law, std::size_t points, const NumberOfEach<double>* pressure, const double* volume,
                 TensorOfEach<Scalar>* tensor) {
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t m = 0; m < members; ++m) {
      const Deformation d(gradient_of(tensor[i], m));
      const Eigen::Matrix3d stress = std::visit(
          [&](const auto& one) -> Eigen::Matrix3d {
            return volume[i] * (one.isochoric_stress(d) + pressure[i].of[m] * one.dilatation_slope(d));
          },
          law.law[m]);
      for (Eigen::Index k = 0; k < 9; ++k) {
        tensor[i].entry[k][m] = static_cast<Scalar>(stress.data()[k]);
      }
    }
  }
}

template <class Scalar>
void find_dilatation(const LawOfEach& law, std::size_t points, const TensorOfEach<Scalar>* tensor,
                     NumberOfEach<double>* dilatation) {
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t m = 0; m < members; ++m) {
      const Deformation d(gradient_of(tensor[i], m));
      dilatation[i].of[m] = std::visit([&](const auto& one) { return one.dilatation(d); }, law.law[m]);
    }
  }
}

/// What the barrier adds to the pressure.
void add_barrier(const LawOfEach& law, std::size_t points, const NumberOfEach<double>* dilatation,
                 NumberOfEach<double>* pressure) {
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t m = 0; m < members; ++m) {
      const double theta = dilatation[i].of[m];
      pressure[i].of[m] += std::visit([&](const auto& one) { return barrier_pressure(one, theta); }, law.law[m]);
    }
  }
}

template <class Scalar>
void sum_at_node(const PointBlocks& points, const std::vector<VectorOfEach<Scalar>>& slot_force, std::size_t node,
                 VectorOfEach<double>& sum) {
  sum = {};
  for (std::int64_t k = points.node_begin[node]; k < points.node_begin[node + 1]; ++k) {
    const auto slot = static_cast<std::size_t>(points.node_slot[static_cast<std::size_t>(k)]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t m = 0; m < members; ++m) {
        sum.of[axis][m] += static_cast<double>(slot_force[slot].of[axis][m]);
      }
    }
  }
}

}  // namespace

template <class Scalar>
EachForceIn<Scalar>::EachForceIn(const PointBlocks& points, std::span<const PointLaws> laws)
    : points_(points), laws_(laws_of_each(laws)), slot_force_(points.slots()), smallest_(points.blocks.size()) {}

template <class Scalar>
EachRoom<Scalar> EachForceIn<Scalar>::room() const {
  std::int32_t most_points = batch_points, most_slots = 0;
  for (const Patch& patch : points_.patches) {
    most_points = std::max(most_points, patch.last_point - patch.first_point);
  }
  for (const Block& block : points_.blocks) {
    most_slots = std::max(most_slots, block.slots);
  }
  const auto batch = static_cast<std::size_t>(most_points);
  return {.displacement = std::vector<VectorOfEach<Scalar>>(static_cast<std::size_t>(most_slots)),
          .tensor = std::vector<TensorOfEach<Scalar>>(batch),
          .dilatation = std::vector<NumberOfEach<double>>(batch),
          .pressure = std::vector<NumberOfEach<double>>(batch)};
}

template <class Scalar>
void EachForceIn<Scalar>::gather(const Block& block, EachRoom<Scalar>& room) const {
  const std::int32_t* node = points_.slot_node.data() + block.first_slot;
  const VectorOfEach<double>& reference = parameters_[static_cast<std::size_t>(node[0])];
  for (std::int32_t s = 0; s < block.slots; ++s) {
    const VectorOfEach<double>& from = parameters_[static_cast<std::size_t>(node[s])];
    VectorOfEach<Scalar>& to = room.displacement[static_cast<std::size_t>(s)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t m = 0; m < members; ++m) {
        to.of[axis][m] = static_cast<Scalar>(from.of[axis][m] - reference.of[axis][m]);
      }
    }
  }
}

/// θ of the points of the patches is known.
template <class Scalar>
void EachForceIn<Scalar>::find_pressures(std::span<const Patch> patches, EachRoom<Scalar>& room) const {
  const auto first = static_cast<std::size_t>(patches.front().first_point);
  const double* mode = points_.mode.empty() ? nullptr : points_.mode.data() + 4 * first;
  each_kernels().front().pressure(mode, points_.volume.data() + first, points_of(patches),
                                  law_of(patches.front()).moduli, room.dilatation.data(), room.pressure.data());
}

template <class Scalar>
void EachForceIn<Scalar>::block_force(const Block& block, EachRoom<Scalar>& room) {
  const EachPairKernels<Scalar>& kernels = each_kernels().front().of<Scalar>();
  const PairRows<Scalar> rows = points_.rows<Scalar>();
  VectorOfEach<Scalar>* force = slot_force_.data() + block.first_slot;
  gather(block, room);
  std::fill_n(force, block.slots, VectorOfEach<Scalar>{});
  NumberOfEach<double>& smallest = smallest_[static_cast<std::size_t>(&block - points_.blocks.data())];
  smallest = {};
  std::span<const Patch> left = std::span(points_.patches)
                                    .subspan(static_cast<std::size_t>(block.first_patch),
                                             static_cast<std::size_t>(block.last_patch - block.first_patch));
  while (!left.empty()) {
    const std::span<const Patch> patches = left.first(patches_at_once(left, !points_.mode.empty()));
    left = left.subspan(patches.size());
    const std::int32_t first = patches.front().first_point, last = patches.back().last_point;
    const double* volume = points_.volume.data() + first;
    const LawOfEach& law = law_of(patches.front());
    const std::size_t points = points_of(patches);
    kernels.gradients(rows, first, last, room.displacement.data(), room.tensor.data());
    NumberOfEach<double> least = {};
    kernels.dilatation(room.tensor.data(), points, room.dilatation.data(), least);
    numbers(smallest.of) = lesser_of_each(numbers(smallest.of), numbers(least.of));
    if (!law.neo_hookean) {
      find_dilatation(law, points, room.tensor.data(), room.dilatation.data());
    }
    find_pressures(patches, room);
    if (!law.neo_hookean || !(numbers(least.of) >= highest_barrier - 1).all()) {
      add_barrier(law, points, room.dilatation.data(), room.pressure.data());
    }
    if (law.neo_hookean) {
      kernels.neo_hookean(room.tensor.data(), points, law.shear_modulus, room.pressure.data(), volume);
    } else {
      find_stress(law, points, room.pressure.data(), volume, room.tensor.data());
    }
    kernels.spread(rows, first, last, room.tensor.data(), force);
  }
}

template <class Scalar>
void EachForceIn<Scalar>::find(const EachVectors& parameters, EachVectors& force) {
  const auto blocks = static_cast<std::int64_t>(points_.blocks.size());
  const auto nodes = static_cast<std::int64_t>(points_.nodes());
  parameters_ = parameters;
  rooms_.resize(static_cast<std::size_t>(omp_get_max_threads()), rooms_.empty() ? room() : rooms_.front());
  share_work(blocks, 1, [&](std::int64_t b, int worker) {
    block_force(points_.blocks[static_cast<std::size_t>(b)], rooms_[static_cast<std::size_t>(worker)]);
  });
  share_work(nodes, places_a_part, [&](std::int64_t a) {
    const auto node = static_cast<std::size_t>(a);
    sum_at_node(points_, slot_force_, node, force[node]);
  });
}

template <class Scalar>
Numbers EachForceIn<Scalar>::smallest_jacobian() const {
  Numbers smallest = Numbers::Zero();
  for (const NumberOfEach<double>& of_block : smallest_) {
    smallest = lesser_of_each(smallest, numbers(of_block.of));
  }
  return 1 + smallest;
}

template EachForceIn<double>::EachForceIn(const PointBlocks&, std::span<const PointLaws>);
template EachForceIn<float>::EachForceIn(const PointBlocks&, std::span<const PointLaws>);
template void EachForceIn<double>::find(const EachVectors&, EachVectors&);
template void EachForceIn<float>::find(const EachVectors&, EachVectors&);
template Numbers EachForceIn<double>::smallest_jacobian() const;
template Numbers EachForceIn<float>::smallest_jacobian() const;
template EachRoom<double> EachForceIn<double>::room() const;
template EachRoom<float> EachForceIn<float>::room() const;
template void EachForceIn<double>::gather(const Block&, EachRoom<double>&) const;
template void EachForceIn<float>::gather(const Block&, EachRoom<float>&) const;
template void EachForceIn<double>::find_pressures(std::span<const Patch>, EachRoom<double>&) const;
template void EachForceIn<float>::find_pressures(std::span<const Patch>, EachRoom<float>&) const;

}  // namespace brainshift::solve
