// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "solve/force/force_scratch.hpp"
#include "solve/force/patch_dilatation.hpp"

namespace brainshift::solve {

// From the gradients at the points of a batch to the stresses there. Neo-Hookean points are handled `lanes` at a time
// by step_kernels(), other laws one at a time.

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

inline Eigen::Matrix3d tensor(const std::vector<TensorLanes>& tensors, std::size_t i) {
  Eigen::Matrix3d result;
  for (std::size_t k = 0; k < 9; ++k) {
    result.data()[k] = tensors[i / lanes].entry[k][i % lanes];
  }
  return result;
}

inline void set(std::vector<TensorLanes>& tensors, std::size_t i, const Eigen::Matrix3d& value) {
  for (std::size_t k = 0; k < 9; ++k) {
    tensors[i / lanes].entry[k][i % lanes] = value.data()[k];
  }
}

/// Consecutive patches of one material, and the room they are worked on in.
struct BatchOf {
  const PointBlocks& points;
  std::span<const Patch> patches;
  Batch& room;

  std::int32_t first() const { return patches.front().first_point; }
  std::int32_t last() const { return patches.back().last_point; }
  std::size_t size() const { return static_cast<std::size_t>(last() - first()); }
};

template <class ElasticLaw>
constexpr bool in_lanes = std::is_same_v<ElasticLaw, NeoHookean>;

/// J and θ.
template <class ElasticLaw>
void find_dilatation(const BatchOf& batch, const ElasticLaw& law, const StepKernels& kernels) {
  Batch& room = batch.room;
  if constexpr (in_lanes<ElasticLaw>) {
    kernels.jacobian(room.gradient.data(), groups_of(batch.size()), room.jacobian.data());
    std::transform(room.jacobian.begin(), room.jacobian.begin() + static_cast<std::ptrdiff_t>(batch.size()),
                   room.dilatation.begin(), [](double jacobian) { return jacobian - 1; });
  } else {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Deformation d(tensor(room.gradient, i));
      room.jacobian[i] = d.jacobian;
      room.dilatation[i] = law.dilatation(d);
    }
  }
}

/// The pressure of each point, of its patch's projected dilatation and its own.
template <class ElasticLaw>
void find_pressure(const BatchOf& batch, const ElasticLaw& law) {
  Batch& room = batch.room;
  for (const Patch& patch : batch.patches) {
    Eigen::Vector4d seen = Eigen::Vector4d::Zero();
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      const auto i = static_cast<std::size_t>(p - batch.first());
      room.volume[i] = batch.points.volume[static_cast<std::size_t>(p)];
      seen += room.volume[i] * room.dilatation[i] * batch.points.modes_of(p);
    }
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      const auto i = static_cast<std::size_t>(p - batch.first());
      room.pressure[i] = point_pressure(law, seen.dot(batch.points.modes_of(p)), room.dilatation[i]);
    }
  }
}

/// Stress times volume.
template <class ElasticLaw, class Viscosity>
void find_stress(const BatchOf& batch, const ElasticLaw& law, const Viscosity& viscosity, const StepKernels& kernels) {
  Batch& room = batch.room;
  if constexpr (in_lanes<ElasticLaw> && std::is_same_v<Viscosity, NotRelaxing>) {
    kernels.neo_hookean(room.gradient.data(), groups_of(batch.size()), law.shear_modulus, room.pressure.data(),
                        room.volume.data(), room.stress.data());
  } else {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Deformation d(tensor(room.gradient, i));
      const Eigen::Matrix3d isochoric = viscosity.stress(law, d, batch.first() + static_cast<std::int32_t>(i));
      set(room.stress, i, room.volume[i] * (isochoric + room.pressure[i] * law.dilatation_slope(d)));
    }
  }
}

template <class ElasticLaw>
void find_thickness(const BatchOf& batch, const ElasticLaw& law, std::span<double> thickness) {
  for (std::size_t i = 0; i < batch.size(); ++i) {
    Eigen::Matrix3d gradient = tensor(batch.room.gradient, i);
    double& of_point = thickness[static_cast<std::size_t>(batch.first()) + i];
    of_point = free_thickness(law, gradient, of_point);
    gradient(2, 2) = of_point;
    set(batch.room.gradient, i, gradient);
  }
}

inline void follow_jacobian(const BatchOf& batch, std::span<double> before, JacobianRange& range) {
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const double jacobian = batch.room.jacobian[i];
    range.smallest = lesser(range.smallest, jacobian);
    if (!before.empty()) {
      double& of_point = before[static_cast<std::size_t>(batch.first()) + i];
      range.least_ratio = lesser(range.least_ratio, jacobian / of_point);
      of_point = jacobian;
    }
  }
}

template <class ElasticLaw>
void batch_stress(const BatchOf& batch, const ElasticLaw& law, const PointLaws& laws, const StepKernels& kernels,
                  ForceScratch& scratch) {
  if (laws.plane_stress) {
    find_thickness(batch, law, scratch.thickness);
  }
  find_dilatation(batch, law, kernels);
  find_pressure(batch, law);
  const auto row = static_cast<std::size_t>(batch.patches.front().material);
  if (laws.prony.empty() || laws.prony[row].terms.empty()) {
    find_stress(batch, law, NotRelaxing{}, kernels);
  } else {
    find_stress(batch, law, Relaxing{&laws.prony[row], &scratch}, kernels);
  }
}

}  // namespace brainshift::solve
