// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/cluster_gradients.hpp"

namespace brainshift::solve::device {

/// P, the first Piola–Kirchhoff stress, as internal_force() has it, in a patch that sees so much of the dilatation.
template <class OneLaw>
BRAINSHIFT_ON_DEVICE Eigen::Matrix3d stress_of(const OneLaw& law, const Deformation& d, double seen) {
  return law.isochoric_stress(d) + point_pressure(law, seen, law.dilatation(d)) * law.dilatation_slope(d);
}

/// Of a law that few bodies have.
BRAINSHIFT_ON_DEVICE BRAINSHIFT_APART inline Eigen::Matrix3d stress_of_other(const Law& law, const Deformation& d,
                                                                             double seen) {
  return visit(law, [&](const auto& of) { return stress_of(of, d, seen); });
}

/// w P of a point.
template <class Scalar>
BRAINSHIFT_ON_DEVICE void find_stress(const View<Scalar>& v, const Cluster& c, const Room<Scalar>& room,
                                      std::int32_t p) {
  const std::int32_t point = c.first_point + p;
  const Deformation d(room.gradient(p));
  const double seen = seen_at(v, c, room, point);
  const Law& law = v.law[v.material[point]];
  const Eigen::Matrix3d stress =
      law.kind == Law::Kind::neo_hookean ? stress_of(law.neo_hookean, d, seen) : stress_of_other(law, d, seen);
  for (int k = 0; k < 9; ++k) {
    room.tensor[k * room.points + p] = static_cast<Scalar>(v.volume[point] * stress.data()[k]);
  }
}

/// Σ w P B of a cluster's slots. Returns as find_dilatations().
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE double cluster_force(const Team& team, const View<Scalar>& v, const Cluster& c, const double* u) {
  const Room<Scalar> room(team.room(), v.most_slots, v.most_points);
  find_gradients(team, v, c, u, room);
  const double minus_smallest = find_dilatations(team, v, c, room);
  for (std::int32_t p = team.thread(); p < c.points; p += team.threads()) {
    find_stress(v, c, room, p);
  }
  team.sync_block();
  constexpr int lanes = Team::lanes;
  const int lane = team.thread() % lanes;
  for (std::int32_t s = team.thread() / lanes; s < c.slots; s += team.threads() / lanes) {
    Scalar sum[3] = {};
    const std::int64_t slot = c.first_slot + s;
    for_entries(team, v.slot_pair, v.slot_begin[slot], v.slot_begin[slot + 1], [&](const Pair<Scalar>& pair) {
      BRAINSHIFT_UNROLLED
      for (int axis = 0; axis < 3; ++axis) {
        BRAINSHIFT_UNROLLED
        for (int row = 0; row < 3; ++row) {
          sum[row] += room.tensor[(3 * axis + row) * room.points + pair.other] * pair.derivative[axis];
        }
      }
    });
    SlotVector<Scalar> force = {};
    for (int row = 0; row < 3; ++row) {
      force.of[row] = team.template sum<lanes>(sum[row]);
    }
    if (lane == 0) {
      v.slot_force[slot] = force;
    }
  }
  team.sync_block();
  return minus_smallest;
}

/// The same of all clusters.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE double slot_forces(const Team& team, const View<Scalar>& v, const double* u) {
  double minus_smallest = -1;
  for (int c = team.block(); c < v.clusters; c += team.blocks()) {
    minus_smallest = larger(minus_smallest, cluster_force(team, v, v.cluster[c], u));
  }
  return minus_smallest;
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
