// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/cluster_gradients.hpp"

namespace brainshift::solve::device {

// A slot's force is summed in whole numbers, which threads may add in any order: in parts of the largest force that
// there can be, 2⁻³¹ of it in single and 2⁻⁶³ in double precision.

/// P, the first Piola–Kirchhoff stress, as internal_force() has it, in a patch that sees so much of the dilatation.
template <class OneLaw>
BRAINSHIFT_ON_DEVICE Eigen::Matrix3d stress_of(const OneLaw& law, const Deformation& d, double seen) {
  return law.isochoric_stress(d) + point_pressure(law, seen, law.dilatation(d)) * law.dilatation_slope(d);
}

/// Of a law that few bodies have. gradient: F, a copy, so that the others' F stays in registers.
BRAINSHIFT_ON_DEVICE BRAINSHIFT_APART inline Eigen::Matrix3d stress_of_other(const Law& law, Eigen::Matrix3d gradient,
                                                                             double seen) {
  const Deformation d(gradient);
  return visit(law, [&](const auto& of) { return stress_of(of, d, seen); });
}

/// Returns the largest entry of w P.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double keep_stress(const Room<Scalar>& room, std::int32_t p, const Eigen::Matrix3d& stress) {
  double largest = 0;
  for (int k = 0; k < 9; ++k) {
    room.tensor[k * room.points + p] = static_cast<Scalar>(stress.data()[k]);
    largest = larger(largest, std::abs(stress.data()[k]));
  }
  return largest;
}

/// w P of a point; returns its largest entry.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double find_stress(const View<Scalar>& v, const Cluster& c, const Room<Scalar>& room,
                                        std::int32_t p) {
  const std::int32_t point = c.first_point + p;
  const Deformation d(room.gradient(p));
  const double seen = seen_at(v, c, room, point);
  const Law& law = v.law[v.material[point]];
  return law.kind == Law::Kind::neo_hookean
             ? keep_stress(room, p, v.volume[point] * stress_of(law.neo_hookean, d, seen))
             : keep_stress(room, p, v.volume[point] * stress_of_other(law, d.gradient, seen));
}

BRAINSHIFT_ON_DEVICE inline std::int32_t whole(float x) {
#ifdef __CUDA_ARCH__
  return __float2int_rn(x);
#else
  return static_cast<std::int32_t>(std::lrint(x));
#endif
}
BRAINSHIFT_ON_DEVICE inline std::int64_t whole(double x) {
#ifdef __CUDA_ARCH__
  return __double2ll_rn(x);
#else
  return std::llrint(x);
#endif
}

/// The largest sum, with room for what rounding adds.
template <class Scalar>
inline constexpr auto most_whole = static_cast<Scalar>(std::is_same_v<Scalar, float> ? 2.147e9 : 9.2e18);

/// Raises what a block has in common by the largest x of its threads.
template <class Team>
BRAINSHIFT_ON_DEVICE void raise_to(const Team& team, std::uint64_t* key, double x) {
  const double of_group = team.template largest<Team::wide>(x);
  if (team.thread() % Team::wide == 0) {
    team.raise(key, rising_key(of_group));
  }
}

/// Σ w P B of a cluster's slots, of the state scale · u. squeezed: raised by −J, if given.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void cluster_force(const Team& team, const View<Scalar>& v, std::int32_t cluster, const double* u,
                                        double scale, const Room<Scalar>& room, std::uint64_t* squeezed) {
  using Whole = typename Room<Scalar>::Whole;
  const Cluster& c = v.cluster[cluster];
  for (std::int32_t i = team.thread(); i < 3 * room.slots; i += team.threads()) {
    room.force[i] = 0;
  }
  if (team.thread() == 0) {
    room.largest[0] = room.largest[1] = 0;
  }
  find_gradients(team, v, cluster, u, scale, room);
  raise_to(team, room.largest + 1, find_dilatations(team, v, c, room));
  double largest = 0;
  for (std::int32_t p = team.thread(); p < c.points; p += team.threads()) {
    largest = larger(largest, find_stress(v, c, room, p));
  }
  raise_to(team, room.largest, largest);
  team.sync_block();
  if (squeezed != nullptr && team.thread() == 0) {
    team.raise(squeezed, room.largest[1]);
  }
  const double most = of_rising_key(room.largest[0]) * v.reach[cluster];
  const auto parts = static_cast<Scalar>(most > 0 ? static_cast<double>(most_whole<Scalar>) / most : most);
  Scalar tensor[9];
  for_slices(
      team, v, cluster, room,
      [&](std::int32_t p) {
        BRAINSHIFT_UNROLLED
        for (int k = 0; k < 9; ++k) {
          tensor[k] = p < 0 ? Scalar{0} : parts * room.tensor[k * room.points + p];
        }
      },
      [&](const Pair<Scalar>& pair) {
        BRAINSHIFT_UNROLLED
        for (int row = 0; row < 3; ++row) {
          const Scalar part = tensor[row] * pair.derivative[0] + tensor[3 + row] * pair.derivative[1] +
                              tensor[6 + row] * pair.derivative[2];
          team.add(room.force + row * room.slots + pair.other, whole(part));
        }
      },
      [](std::int32_t) {});
  team.sync_block();
  const double part = most / static_cast<double>(most_whole<Scalar>);
  for (std::int32_t s = team.thread(); s < c.slots; s += team.threads()) {
    SlotVector<Scalar> force = {};
    for (int row = 0; row < 3; ++row) {
      const Whole sum = room.force[row * room.slots + s];
      force.of[row] = static_cast<Scalar>(part * static_cast<double>(sum));
    }
    v.slot_force[c.first_slot + s] = force;
  }
  team.sync_block();
}

/// The same of all clusters.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void slot_forces(const Team& team, const View<Scalar>& v, const double* u, double scale,
                                      const Room<Scalar>& room, std::uint64_t* squeezed) {
  for (int c = team.block(); c < v.clusters; c += team.blocks()) {
    cluster_force(team, v, c, u, scale, room, squeezed);
  }
}

/// f_int of a component of a node, from the slots in their order, µN.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double force_at_node(const View<Scalar>& v, std::int32_t node, int axis) {
  double sum = 0;
  BRAINSHIFT_AHEAD
  for (std::int64_t k = v.node_begin[node]; k < v.node_begin[node + 1]; ++k) {
    sum += static_cast<double>(v.slot_force[v.node_slot[k]].of[axis]);
  }
  return sum;
}

}  // namespace brainshift::solve::device
