// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/internal_force.hpp"

#include <omp.h>

#include <algorithm>

#include "solve/arrays/shared_work.hpp"
#include "solve/force/batch_stress.hpp"

namespace brainshift::solve {

namespace {

/// The patches from the first that are worked on at once.
std::size_t batch_length(std::span<const Patch> patches) {
  std::size_t length = 1;
  while (length < patches.size() && patches[length].material == patches[0].material &&
         patches[length].last_point - patches[0].first_point <= batch_points) {
    ++length;
  }
  return length;
}

template <class Scalar>
void gather(const PointBlocks& points, const Block& block, const NodalVectors& parameters, Scalar* displacement) {
  const std::int32_t* node = points.slot_node.data() + block.first_slot;
  const double* reference = parameters.data() + 4 * static_cast<std::size_t>(node[0]);
  for (std::int32_t s = 0; s < block.slots; ++s) {
    const double* from = parameters.data() + 4 * static_cast<std::size_t>(node[s]);
    for (int i = 0; i < 4; ++i) {
      displacement[4 * s + i] = static_cast<Scalar>(from[i] - reference[i]);
    }
  }
}

void scale(std::vector<TensorLanes>& tensors, std::size_t points, double factor) {
  for (std::size_t g = 0; g < groups_of(points); ++g) {
    for (auto& entry : tensors[g].entry) {
      for (double& value : entry) {
        value *= factor;
      }
    }
  }
}

template <class Scalar>
void block_force(const PointBlocks& points, const Block& block, const PointLaws& laws, const NodalVectors& parameters,
                 ForceScratch& scratch, Batch& room) {
  const StepKernels& kernels = step_kernels().front();
  Scalar* displacement = room.displacement.of<Scalar>().data();
  Scalar* force = scratch.force.of<Scalar>().data() + 4 * static_cast<std::size_t>(block.first_slot);
  gather(points, block, parameters, displacement);
  std::fill_n(force, 4 * static_cast<std::size_t>(block.slots), Scalar{0});
  JacobianRange range;
  std::span<const Patch> left = std::span(points.patches)
                                    .subspan(static_cast<std::size_t>(block.first_patch),
                                             static_cast<std::size_t>(block.last_patch - block.first_patch));
  while (!left.empty()) {
    const BatchOf batch{points, left.first(batch_length(left)), room};
    left = left.subspan(batch.patches.size());
    const PairRows<Scalar> rows = points.rows<Scalar>();
    kernels.of<Scalar>().gradients(rows, batch.first(), batch.last(), displacement, room.gradient.data());
    const double growth = scratch.growth_of(batch.patches.front().material);
    if (growth != 1) {
      scale(room.gradient, batch.size(), 1 / growth);
    }
    std::visit([&](const auto& law) { batch_stress(batch, law, laws, kernels, scratch); },
               laws.elastic[static_cast<std::size_t>(batch.patches.front().material)]);
    if (growth != 1) {
      scale(room.stress, batch.size(), growth * growth);
    }
    kernels.of<Scalar>().spread(rows, batch.first(), batch.last(), room.stress.data(), force);
    follow_jacobian(batch, scratch.jacobian, range);
  }
  scratch.block_jacobian[static_cast<std::size_t>(&block - points.blocks.data())] = range;
}

template <class Scalar>
void sum_at_node(const PointBlocks& points, const std::vector<Scalar>& slot_force, std::size_t node, double* sum) {
  std::fill_n(sum, 4, 0.0);
  for (std::int64_t k = points.node_begin[node]; k < points.node_begin[node + 1]; ++k) {
    const auto slot = static_cast<std::size_t>(points.node_slot[static_cast<std::size_t>(k)]);
    for (std::size_t i = 0; i < 4; ++i) {
      sum[i] += static_cast<double>(slot_force[4 * slot + i]);
    }
  }
}

template <class Scalar>
void force_of(const PointBlocks& points, const PointLaws& laws, const NodalVectors& parameters, ForceScratch& scratch,
              NodalVectors& force) {
  const auto blocks = static_cast<std::int64_t>(points.blocks.size());
  const auto nodes = static_cast<std::int64_t>(points.nodes());
  scratch.batches.resize(static_cast<std::size_t>(omp_get_max_threads()), scratch.batches.front());
  share_work(blocks, 1, [&](std::int64_t b, int worker) {
    block_force<Scalar>(points, points.blocks[static_cast<std::size_t>(b)], laws, parameters, scratch,
                        scratch.batches[static_cast<std::size_t>(worker)]);
  });
  share_work(nodes, nodes_a_part, [&](std::int64_t a) {
    const auto node = static_cast<std::size_t>(a);
    at(scratch.parameters, node) = at(parameters, node);
    sum_at_node(points, scratch.force.of<Scalar>(), node, force.data() + 4 * node);
  });
}

template <class Scalar>
Eigen::Matrix3d gradient_at(const PointBlocks& points, std::int32_t point, const std::int32_t* slot_node,
                            const NodalVectors& parameters) {
  Eigen::Vector4d column[3] = {Eigen::Vector4d::UnitX(), Eigen::Vector4d::UnitY(), Eigen::Vector4d::UnitZ()};
  const Scalar* derivative = points.derivatives_of<Scalar>(point);
  for (const std::uint16_t slot : points.slots_of(point)) {
    const auto of_node = at(parameters, static_cast<std::size_t>(slot_node[slot]));
    for (Eigen::Vector4d& c : column) {
      c += of_node * static_cast<double>(*derivative++);
    }
  }
  Eigen::Matrix3d gradient;
  gradient << column[0].head<3>(), column[1].head<3>(), column[2].head<3>();
  return gradient;
}

}  // namespace

JacobianRange jacobian_range(const ForceScratch& scratch) {
  JacobianRange range;
  for (const JacobianRange& of_block : scratch.block_jacobian) {
    range.smallest = lesser(range.smallest, of_block.smallest);
    range.least_ratio = lesser(range.least_ratio, of_block.least_ratio);
  }
  return range;
}

void internal_force(const PointBlocks& points, const PointLaws& laws, const NodalVectors& parameters,
                    ForceScratch& scratch, NodalVectors& force) {
  if (points.precision() == Precision::single_precision) {
    force_of<float>(points, laws, parameters, scratch, force);
  } else {
    force_of<double>(points, laws, parameters, scratch, force);
  }
}

std::vector<Eigen::Matrix3d> gradients_of(const PointBlocks& points, const Patch& patch, const ForceScratch& scratch) {
  const std::int32_t* slot_node = points.slot_node.data() + patch.first_slot;
  std::vector<Eigen::Matrix3d> gradients;
  gradients.reserve(static_cast<std::size_t>(patch.last_point - patch.first_point));
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    gradients.push_back(points.precision() == Precision::single_precision
                            ? gradient_at<float>(points, p, slot_node, scratch.parameters)
                            : gradient_at<double>(points, p, slot_node, scratch.parameters));
    gradients.back() /= scratch.growth_of(patch.material);
    if (!scratch.thickness.empty()) {
      gradients.back()(2, 2) = scratch.thickness[static_cast<std::size_t>(p)];
    }
  }
  return gradients;
}

}  // namespace brainshift::solve
