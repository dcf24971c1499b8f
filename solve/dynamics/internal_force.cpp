// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/internal_force.hpp"

#include <algorithm>
#include <cmath>

#include "solve/dynamics/patch_dilatation.hpp"

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
template <class Scalar>
[[gnu::always_inline]] inline void add_up_gradient(std::span<const std::uint16_t> slots, const Scalar* derivative,
                                                   const double* displacement, double* gradient) {
  Lane column[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  for (const std::uint16_t slot : slots) {
    Lane u;
    __builtin_memcpy(&u, displacement + 4 * std::size_t{slot}, sizeof u);
    for (int axis = 0; axis < 3; ++axis) {
      column[axis] += u * double{derivative[axis]};
    }
    derivative += 3;
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) {
      gradient[3 * axis + i] = column[axis][i];
    }
  }
}

BRAINSHIFT_KERNEL
void deformation_gradient(std::span<const std::uint16_t> slots, const double* derivative, const double* displacement,
                          double* gradient) {
  add_up_gradient(slots, derivative, displacement, gradient);
}

BRAINSHIFT_KERNEL
void deformation_gradient(std::span<const std::uint16_t> slots, const float* derivative, const double* displacement,
                          double* gradient) {
  add_up_gradient(slots, derivative, displacement, gradient);
}

/// f_a += wP · B_a.
template <class Scalar>
[[gnu::always_inline]] inline void spread_stress(std::span<const std::uint16_t> slots, const Scalar* derivative,
                                                 const double* stress, double* force) {
  Lane column[3];
  for (int axis = 0; axis < 3; ++axis) {
    column[axis] = Lane{stress[3 * axis], stress[3 * axis + 1], stress[3 * axis + 2], 0};
  }
  for (const std::uint16_t slot : slots) {
    double* at = force + 4 * std::size_t{slot};
    Lane f;
    __builtin_memcpy(&f, at, sizeof f);
    for (int axis = 0; axis < 3; ++axis) {
      f += column[axis] * double{derivative[axis]};
    }
    __builtin_memcpy(at, &f, sizeof f);
    derivative += 3;
  }
}

BRAINSHIFT_KERNEL
void scatter_stress(std::span<const std::uint16_t> slots, const double* derivative, const double* stress,
                    double* force) {
  spread_stress(slots, derivative, stress, force);
}

BRAINSHIFT_KERNEL
void scatter_stress(std::span<const std::uint16_t> slots, const float* derivative, const double* stress,
                    double* force) {
  spread_stress(slots, derivative, stress, force);
}

/// F_33 for which P_33 = 0, by the secant method from the last step's.
template <class ElasticLaw>
double free_thickness(const ElasticLaw& law, Eigen::Matrix3d gradient, double start) {
  constexpr int most = 50;
  constexpr double relative = 1e-10;
  const auto normal_stress = [&](double stretch) {
    gradient(2, 2) = stretch;
    const Deformation d(gradient);
    return law.isochoric_stress(d)(2, 2) +
           point_pressure(law, law.dilatation(d), law.dilatation(d)) * law.dilatation_slope(d)(2, 2);
  };
  double before = start * (1 + 1e-4), now = start;
  double stress_before = normal_stress(before), stress = normal_stress(now);
  for (int i = 0; i < most && std::abs(stress) > relative * law.bulk_modulus && stress != stress_before; ++i) {
    const double next = now - stress * (now - before) / (stress - stress_before);
    before = now;
    stress_before = stress;
    now = std::clamp(next, now / 2, 2 * now);
    stress = normal_stress(now);
  }
  return now;
}

/// Where a patch's points keep what a time step of Prony terms needs; nothing for a law that does not relax.
struct Relaxing {
  const PronyStep* step;
  ForceScratch* scratch;

  template <class ElasticLaw>
  Eigen::Matrix3d stress(const ElasticLaw& law, const Deformation& d, std::int32_t point) const {
    const std::size_t begin = scratch->viscous_begin[static_cast<std::size_t>(point)];
    return viscous_stress(law, *step, d,
                          std::span(scratch->viscous_state).subspan(begin, viscous_state_size(step->terms.size())));
  }
};

struct NotRelaxing {
  template <class ElasticLaw>
  Eigen::Matrix3d stress(const ElasticLaw& law, const Deformation& d, std::int32_t) const {
    return law.isochoric_stress(d);
  }
};

template <class Scalar, class ElasticLaw>
void patch_gradients(const PointBlocks& points, const Patch& patch, const ElasticLaw& law, bool plane_stress,
                     const double* displacement, ForceScratch& scratch) {
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const auto i = static_cast<std::size_t>(p);
    deformation_gradient(points.slots_of(p), points.derivatives_of<Scalar>(p), displacement,
                         scratch.gradient.data() + 9 * i);
    if (plane_stress) {
      scratch.thickness[i] = free_thickness(law, gradient_of(scratch, p), scratch.thickness[i]);
      scratch.gradient[9 * i + 8] = scratch.thickness[i];
    }
  }
}

template <class Scalar, class ElasticLaw, class Viscosity>
void patch_force(const PointBlocks& points, const Patch& patch, const ElasticLaw& law, const Viscosity& viscosity,
                 double* force, ForceScratch& scratch, JacobianRange& range) {
  const Eigen::Vector4d dilatations = projected_dilatation(points, patch, law, scratch);
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const Deformation d(gradient_of(scratch, p));
    const double pressure = point_pressure(law, dilatations.dot(points.modes_of(p)), law.dilatation(d));
    const Eigen::Matrix3d stress =
        points.volume[static_cast<std::size_t>(p)] * (viscosity.stress(law, d, p) + pressure * law.dilatation_slope(d));
    scatter_stress(points.slots_of(p), points.derivatives_of<Scalar>(p), stress.data(), force);
    range.smallest = lesser(range.smallest, d.jacobian);
    if (!scratch.jacobian.empty()) {
      double& jacobian = scratch.jacobian[static_cast<std::size_t>(p)];
      range.least_ratio = lesser(range.least_ratio, d.jacobian / jacobian);
      jacobian = d.jacobian;
    }
  }
}

template <class Scalar>
void block_force(const PointBlocks& points, const Block& block, const PointLaws& laws, const NodalVectors& parameters,
                 ForceScratch& scratch) {
  const auto first = static_cast<std::size_t>(block.first_slot);
  const auto slots = static_cast<std::size_t>(block.slots);
  double* displacement = scratch.slot_displacement.data() + 4 * first;
  double* force = scratch.slot_force.data() + 4 * first;
  for (std::size_t s = 0; s < slots; ++s) {
    const auto node = static_cast<std::size_t>(points.slot_node[first + s]);
    std::copy_n(parameters.data() + 4 * node, 4, displacement + 4 * s);
  }
  std::fill_n(force, 4 * slots, 0.0);
  JacobianRange range;
  for (std::int32_t i = block.first_patch; i < block.last_patch; ++i) {
    const Patch& patch = points.patches[static_cast<std::size_t>(i)];
    const auto row = static_cast<std::size_t>(patch.material);
    std::visit(
        [&](const auto& law) {
          patch_gradients<Scalar>(points, patch, law, laws.plane_stress, displacement, scratch);
          if (laws.prony.empty() || laws.prony[row].terms.empty()) {
            patch_force<Scalar>(points, patch, law, NotRelaxing{}, force, scratch, range);
          } else {
            const Relaxing relaxing{&laws.prony[row], &scratch};
            patch_force<Scalar>(points, patch, law, relaxing, force, scratch, range);
          }
        },
        laws.elastic[row]);
  }
  scratch.block_jacobian[static_cast<std::size_t>(&block - points.blocks.data())] = range;
}

}  // namespace

ForceScratch::ForceScratch(const PointBlocks& points, const PointLaws& laws)
    : slot_displacement(4 * points.slots()),
      slot_force(4 * points.slots()),
      gradient(9 * points.points()),
      block_jacobian(points.blocks.size()) {
  if (laws.in_time) {
    jacobian.assign(points.points(), 1.0);
  }
  if (laws.plane_stress) {
    thickness.assign(points.points(), 1.0);
  }
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
      const std::size_t end = k + 1 < from.size() ? other.viscous_begin[k + 1] : other.viscous_state.size();
      std::copy(other.viscous_state.begin() + static_cast<std::ptrdiff_t>(other.viscous_begin[k]),
                other.viscous_state.begin() + static_cast<std::ptrdiff_t>(end),
                viscous_state.begin() + static_cast<std::ptrdiff_t>(viscous_begin[i]));
    }
  }
}

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
  const auto blocks = static_cast<std::int64_t>(points.blocks.size());
  const auto nodes = static_cast<std::int64_t>(points.nodes());
#pragma omp parallel
  {
#pragma omp for schedule(dynamic)
    for (std::int64_t b = 0; b < blocks; ++b) {
      const Block& block = points.blocks[static_cast<std::size_t>(b)];
      if (points.precision() == Precision::single_precision) {
        block_force<float>(points, block, laws, parameters, scratch);
      } else {
        block_force<double>(points, block, laws, parameters, scratch);
      }
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

}  // namespace brainshift::solve
