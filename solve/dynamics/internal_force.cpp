// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/internal_force.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace brainshift::solve {

namespace {

// The two loops over (point, node) pairs are most of the time of a run. They are compiled for three levels of the
// x86-64 instruction set, of which the loader picks the best.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define BRAINSHIFT_KERNEL __attribute__((target_clones("default", "avx2", "arch=skylake-avx512")))
#else
#define BRAINSHIFT_KERNEL
#endif

using Lane = double __attribute__((vector_size(32)));

/// F = 1 + Σ_a û_a ⊗ B_a, column-major into gradient[9].
BRAINSHIFT_KERNEL
void deformation_gradient(std::span<const std::uint16_t> slots, const double* derivative, const double* displacement,
                          double* gradient) {
  Lane column[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  for (const std::uint16_t slot : slots) {
    Lane u;
    __builtin_memcpy(&u, displacement + 4 * std::size_t{slot}, sizeof u);
    for (int axis = 0; axis < 3; ++axis) {
      column[axis] += u * derivative[axis];
    }
    derivative += 3;
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) {
      gradient[3 * axis + i] = column[axis][i];
    }
  }
}

/// f_a += wP · B_a.
BRAINSHIFT_KERNEL
void scatter_stress(std::span<const std::uint16_t> slots, const double* derivative, const double* stress,
                    double* force) {
  Lane column[3];
  for (int axis = 0; axis < 3; ++axis) {
    column[axis] = Lane{stress[3 * axis], stress[3 * axis + 1], stress[3 * axis + 2], 0};
  }
  for (const std::uint16_t slot : slots) {
    double* at = force + 4 * std::size_t{slot};
    Lane f;
    __builtin_memcpy(&f, at, sizeof f);
    for (int axis = 0; axis < 3; ++axis) {
      f += column[axis] * derivative[axis];
    }
    __builtin_memcpy(at, &f, sizeof f);
    derivative += 3;
  }
}

Eigen::Map<const Eigen::Matrix3d> gradient_of(const ForceScratch& scratch, std::int32_t point) {
  return Eigen::Map<const Eigen::Matrix3d>(scratch.gradient.data() + 9 * static_cast<std::size_t>(point));
}

double mean_jacobian(const PointBlocks& points, const Patch& patch, const ForceScratch& scratch) {
  double swept = 0;
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    swept += points.volume[static_cast<std::size_t>(p)] * Deformation(gradient_of(scratch, p)).jacobian;
  }
  return swept / patch.volume;
}

void patch_force(const PointBlocks& points, const Patch& patch, const NeoHookean& law, const double* displacement,
                 double* force, ForceScratch& scratch) {
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    deformation_gradient(points.slots_of(p), points.derivatives_of(p), displacement,
                         scratch.gradient.data() + 9 * static_cast<std::size_t>(p));
  }
  const double pressure = law.pressure(mean_jacobian(points, patch, scratch));
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const Deformation d(gradient_of(scratch, p));
    const Eigen::Matrix3d stress =
        points.volume[static_cast<std::size_t>(p)] * (law.isochoric_stress(d) + pressure * d.cofactor);
    scatter_stress(points.slots_of(p), points.derivatives_of(p), stress.data(), force);
  }
}

void block_force(const PointBlocks& points, const Block& block, std::span<const NeoHookean> laws,
                 const NodalVectors& parameters, ForceScratch& scratch) {
  const auto first = static_cast<std::size_t>(block.first_slot);
  const auto slots = static_cast<std::size_t>(block.slots);
  double* displacement = scratch.slot_displacement.data() + 4 * first;
  double* force = scratch.slot_force.data() + 4 * first;
  for (std::size_t s = 0; s < slots; ++s) {
    const auto node = static_cast<std::size_t>(points.slot_node[first + s]);
    std::copy_n(parameters.data() + 4 * node, 4, displacement + 4 * s);
  }
  std::fill_n(force, 4 * slots, 0.0);
  for (std::int32_t i = block.first_patch; i < block.last_patch; ++i) {
    const Patch& patch = points.patches[static_cast<std::size_t>(i)];
    patch_force(points, patch, laws[static_cast<std::size_t>(patch.material)], displacement, force, scratch);
  }
}

Eigen::Vector3d principal_stretches(const Eigen::Matrix3d& gradient) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(gradient.transpose() * gradient, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().cwiseMax(1e-8).cwiseSqrt();
}

}  // namespace

void internal_force(const PointBlocks& points, std::span<const NeoHookean> laws, const NodalVectors& parameters,
                    ForceScratch& scratch, NodalVectors& force) {
  const auto blocks = static_cast<std::int64_t>(points.blocks.size());
  const auto nodes = static_cast<std::int64_t>(points.nodes());
#pragma omp parallel
  {
#pragma omp for schedule(dynamic)
    for (std::int64_t b = 0; b < blocks; ++b) {
      block_force(points, points.blocks[static_cast<std::size_t>(b)], laws, parameters, scratch);
    }
#pragma omp for schedule(static)
    for (std::int64_t a = 0; a < nodes; ++a) {
      const auto node = static_cast<std::size_t>(a);
      Eigen::Vector4d sum = Eigen::Vector4d::Zero();
      for (std::int64_t k = points.node_begin[node]; k < points.node_begin[node + 1]; ++k) {
        const auto slot = static_cast<std::size_t>(points.node_slot[static_cast<std::size_t>(k)]);
        sum += Eigen::Map<const Eigen::Vector4d>(scratch.slot_force.data() + 4 * slot);
      }
      Eigen::Map<Eigen::Vector4d>(force.data() + 4 * node) = sum;
    }
  }
}

namespace {

PointState block_state(const PointBlocks& points, const Block& block, std::span<const NeoHookean> laws,
                       const ForceScratch& scratch) {
  PointState state;
  for (std::int32_t i = block.first_patch; i < block.last_patch; ++i) {
    const Patch& patch = points.patches[static_cast<std::size_t>(i)];
    const NeoHookean& law = laws[static_cast<std::size_t>(patch.material)];
    state.strain_energy += patch.volume * law.volumetric_energy(mean_jacobian(points, patch, scratch));
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      const Deformation d(gradient_of(scratch, p));
      state.strain_energy += points.volume[static_cast<std::size_t>(p)] * law.isochoric_energy(d);
      // written so that a NaN stays
      state.smallest_jacobian = d.jacobian >= state.smallest_jacobian ? state.smallest_jacobian : d.jacobian;
      state.largest_stretch = std::max(state.largest_stretch, principal_stretches(d.gradient).maxCoeff());
    }
  }
  return state;
}

}  // namespace

PointState point_state(const PointBlocks& points, std::span<const NeoHookean> laws, const ForceScratch& scratch) {
  std::vector<PointState> partial(points.blocks.size());
  const auto blocks = static_cast<std::int64_t>(points.blocks.size());
#pragma omp parallel for schedule(dynamic)
  for (std::int64_t b = 0; b < blocks; ++b) {
    const auto i = static_cast<std::size_t>(b);
    partial[i] = block_state(points, points.blocks[i], laws, scratch);
  }
  PointState state;
  for (const PointState& part : partial) {
    state.strain_energy += part.strain_energy;
    state.smallest_jacobian =
        part.smallest_jacobian >= state.smallest_jacobian ? state.smallest_jacobian : part.smallest_jacobian;
    state.largest_stretch = std::max(state.largest_stretch, part.largest_stretch);
  }
  return state;
}

std::vector<double> tangent_moduli(const PointBlocks& points, std::span<const NeoHookean> laws,
                                   const ForceScratch& scratch) {
  std::vector<double> moduli(points.points());
  const auto patches = static_cast<std::int64_t>(points.patches.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < patches; ++i) {
    const Patch& patch = points.patches[static_cast<std::size_t>(i)];
    const NeoHookean& law = laws[static_cast<std::size_t>(patch.material)];
    const double pressure = law.pressure(mean_jacobian(points, patch, scratch));
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      const double tangent = largest_tangent(law, principal_stretches(gradient_of(scratch, p)), pressure);
      moduli[static_cast<std::size_t>(p)] = std::max(tangent, law.wave_modulus());
    }
  }
  return moduli;
}

}  // namespace brainshift::solve
