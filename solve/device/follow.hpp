// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/node_step.hpp"

namespace brainshift::solve::device {

// The bound D of the stiffness as stiffness_bound() has it, here in four passes: the points, the patches' nodes, the
// patches, the slots. Nodes share a bound by NodeShares.

/// g of a node, one of the cluster's slots.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double firmness_of(const View<Scalar>& v, std::int64_t slot) {
  return v.firmness[v.slot_node[slot]];
}

BRAINSHIFT_ON_DEVICE inline double share_of(const SharedBound& bound, double firmness) {
  return std::max(firmness / bound.firmest, bound.least);
}

template <class Scalar>
BRAINSHIFT_ON_DEVICE double length(const Pair<Scalar>& pair) {
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    square += static_cast<double>(pair.derivative[axis]) * static_cast<double>(pair.derivative[axis]);
  }
  return std::sqrt(square);
}

/// w C of the change of shape.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double tangent_at(const View<Scalar>& v, const Cluster& c, const Room<Scalar>& room,
                                       std::int32_t p) {
  const std::int32_t point = c.first_point + p;
  const Deformation d(room.gradient(p));
  const double seen = seen_at(v, c, room, point);
  return v.volume[point] * visit(v.law[v.material[point]], [&](const auto& law) {
           auto alone = law;  // as its patch leaves it to the point
           const double dilatation = law.dilatation(d);
           alone.bulk_modulus = point_modulus(law, dilatation);
           const double tangent = largest_tangent(alone, d.gradient, point_pressure(law, seen, dilatation));
           return std::max(tangent, 2 * law.shear_modulus);
         });
}

/// How nodes share a bound, as NodeShares has it, by the lanes that go through them: firmness(k) and reach(k) of those
/// from `first` on. Each lane has all of it.
template <class Team, class Firmness, class Reach>
BRAINSHIFT_ON_DEVICE SharedBound shared_by(const Team& team, std::int64_t first, std::int64_t end,
                                           const Firmness& firmness, const Reach& reach) {
  constexpr int lanes = Team::lanes;
  SharedBound bound{.scale = 0, .firmest = 0, .least = 1};
  for (std::int64_t k = first; k < end; k += lanes) {
    bound.firmest = larger(bound.firmest, firmness(k));
  }
  bound.firmest = team.template largest<lanes>(bound.firmest);
  double soft = 0, all = 0;
  for (std::int64_t k = first; k < end; k += lanes) {
    const double of_node = reach(k);
    soft += of_node * (1 - firmness(k) / bound.firmest);
    all += of_node;
  }
  soft = team.template sum<lanes>(soft);
  all = team.template sum<lanes>(all);
  bound.least = all > 0 ? soft / all : 1;
  return bound;
}

/// ‖Σ B ⊗ B / (h |B|)‖ of a point, and how its nodes share it; each lane has all of it.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE SharedBound norm_at(const Team& team, const View<Scalar>& v, const Cluster& c,
                                         std::int32_t point) {
  constexpr int lanes = Team::lanes;
  const std::int64_t first = v.pair_begin[point] + team.thread() % lanes, end = v.pair_begin[point + 1];
  const auto firmness = [&](std::int64_t k) { return firmness_of(v, c.first_slot + v.pair[k].other); };
  SharedBound bound = shared_by(team, first, end, firmness, [&](std::int64_t k) { return length(v.pair[k]); });
  double upper[6] = {};
  for (std::int64_t k = first; k < end; k += lanes) {
    const Pair<Scalar> pair = v.pair[k];
    const double reach = length(pair);
    const double weight = reach > 0 ? 1 / (share_of(bound, firmness(k)) * reach) : 0;
    const double b[3] = {static_cast<double>(pair.derivative[0]), static_cast<double>(pair.derivative[1]),
                         static_cast<double>(pair.derivative[2])};
    for (int i = 0, n = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        upper[n++] += weight * b[i] * b[j];
      }
    }
  }
  for (double& entry : upper) {
    entry = team.template sum<lanes>(entry);
  }
  Eigen::Matrix3d sum;
  sum << upper[0], upper[1], upper[2], upper[1], upper[3], upper[4], upper[2], upper[4], upper[5];
  bound.scale = symmetric_eigenvalues(sum)[2];
  return bound;
}

/// Σ w ψ ∂θ/∂F B of each mode and Σ w |B|, of a node and a patch that touches it.
template <class Scalar>
BRAINSHIFT_ON_DEVICE void find_touch(const View<Scalar>& v, const Cluster& c, const Room<Scalar>& room,
                                     std::int64_t at) {
  const Touch& touch = v.touch[at];
  const Law& law = v.law[v.patch[touch.patch].material];
  Eigen::Matrix<double, 3, 4> sum = Eigen::Matrix<double, 3, 4>::Zero();
  double reach = 0;
  for (std::int64_t k = touch.first; k < touch.first + touch.pairs; ++k) {
    const Pair<Scalar> pair = v.slot_pair[k];
    const std::int32_t point = c.first_point + pair.other;
    const Deformation d(room.gradient(pair.other));
    const Eigen::Vector3d b(static_cast<double>(pair.derivative[0]), static_cast<double>(pair.derivative[1]),
                            static_cast<double>(pair.derivative[2]));
    const Eigen::Vector3d slope =
        visit(law, [&](const auto& of) -> Eigen::Vector3d { return v.volume[point] * (of.dilatation_slope(d) * b); });
    for (int mode = 0; mode < 4; ++mode) {
      sum.col(mode) += mode_of(v, point, mode) * slope;
    }
    reach += v.volume[point] * length(pair);
  }
  for (int mode = 0; mode < 4; ++mode) {
    v.touch_norm[at].of[mode] = sum.col(mode).norm();
  }
  v.touch_reach[at] = reach;
}

/// K and Σ |b|/h of each mode of a patch, and how its nodes share it.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_total(const Team& team, const View<Scalar>& v, std::int32_t patch) {
  constexpr int lanes = Team::lanes;
  const std::int64_t begin = v.patch_touch_begin[patch] + team.thread() % lanes, end = v.patch_touch_begin[patch + 1];
  const auto firmness = [&](std::int64_t k) { return v.firmness[v.patch_touch_node[k]]; };
  SharedBound bound =
      shared_by(team, begin, end, firmness, [&](std::int64_t k) { return v.touch_reach[v.patch_touch[k]]; });
  double total[4] = {};
  for (std::int64_t k = begin; k < end; k += lanes) {
    for (int mode = 0; mode < 4; ++mode) {
      total[mode] += v.touch_norm[v.patch_touch[k]].of[mode] / share_of(bound, firmness(k));
    }
  }
  bound.scale = visit(v.law[v.patch[patch].material], [](const auto& law) { return law.bulk_modulus; });
  for (int mode = 0; mode < 4; ++mode) {
    total[mode] = team.template sum<lanes>(total[mode]);
  }
  if (team.thread() % lanes == 0) {
    v.patch_bound[patch] = bound;
    for (int mode = 0; mode < 4; ++mode) {
      v.patch_total[patch].of[mode] = total[mode];
    }
  }
}

template <class Scalar>
BRAINSHIFT_ON_DEVICE double bound_of_slot(const View<Scalar>& v, const Cluster& c, std::int64_t slot) {
  const double firmness = firmness_of(v, slot);
  double sum = 0;
  for (std::int64_t k = v.slot_begin[slot]; k < v.slot_begin[slot + 1]; ++k) {
    const SharedBound& bound = v.point_bound[c.first_point + v.slot_pair[k].other];
    sum += bound.scale * share_of(bound, firmness) * length(v.slot_pair[k]);
  }
  for (std::int64_t k = v.touch_begin[slot]; k < v.touch_begin[slot + 1]; ++k) {
    const std::int32_t patch = v.touch[k].patch;
    const SharedBound& bound = v.patch_bound[patch];
    for (int mode = 0; mode < 4; ++mode) {
      sum += bound.scale * share_of(bound, firmness) * v.patch_total[patch].of[mode] * v.touch_norm[k].of[mode];
    }
  }
  return sum;
}

/// `slot_bound` at the state u. Returns as find_dilatations().
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE double find_slot_bounds(const Team& team, const View<Scalar>& v, const double* u) {
  constexpr int lanes = Team::lanes;
  const Room<Scalar> room(team.room(), v.most_slots, v.most_points);
  double minus_smallest = -1;
  for (int i = team.block(); i < v.clusters; i += team.blocks()) {
    const Cluster& c = v.cluster[i];
    find_gradients(team, v, c, u, room);
    minus_smallest = larger(minus_smallest, find_dilatations(team, v, c, room));
    for (std::int32_t p = team.thread() / lanes; p < c.points; p += team.threads() / lanes) {
      SharedBound bound = norm_at(team, v, c, c.first_point + p);
      if (team.thread() % lanes == 0) {
        bound.scale *= tangent_at(v, c, room, p);
        v.point_bound[c.first_point + p] = bound;
      }
    }
    const std::int64_t first = v.touch_begin[c.first_slot], last = v.touch_begin[c.first_slot + c.slots];
    for (std::int64_t k = first + team.thread(); k < last; k += team.threads()) {
      find_touch(v, c, room, k);
    }
    team.sync_block();
    for (std::int32_t k = team.thread() / lanes; k < c.patches; k += team.threads() / lanes) {
      find_total(team, v, c.first_patch + k);
    }
    team.sync_block();
    for (std::int64_t s = c.first_slot + team.thread(); s < c.first_slot + c.slots; s += team.threads()) {
      v.slot_bound[s] = bound_of_slot(v, c, s);
    }
    team.sync_block();
  }
  return minus_smallest;
}

/// The masses that the stiffness at the last force wants, and whether it wants others than there are.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void follow_stiffness(const Team& team, const View<Scalar>& v, const Order& order,
                                           const Motion& m) {
  double of[FollowSums::count] = {};
  of[FollowSums::minus_jacobian] = find_slot_bounds(team, v, m.before);
  team.sync_all();
  for (std::int32_t a = first_of_all(team); a < v.nodes; a += all_threads(team)) {
    double bound = 0;
    for (std::int64_t k = v.node_begin[a]; k < v.node_begin[a + 1]; ++k) {
      bound += v.slot_bound[v.node_slot[k]];
    }
    const double mass = v.mass[a];
    v.stiffer_mass[a] = std::max(mass, order.mass_margin * order.mass_scale * bound);
    of[FollowSums::stiffer] = larger(of[FollowSums::stiffer], order.mass_scale * bound > mass ? 1 : 0);
    for (std::int64_t i = 4 * static_cast<std::int64_t>(a); i < 4 * static_cast<std::int64_t>(a) + 3; ++i) {
      const double moved = m.now[i] - m.before[i];
      of[FollowSums::inertia] += mass * moved * moved;
      of[FollowSums::inertia_then] += v.stiffer_mass[a] * moved * moved;
    }
  }
  leave<FollowSums::sums>(team, of, v.partial);
  team.sync_all();
  if (team.block() == 0) {
    collect<FollowSums::sums, FollowSums::count>(team, v.partial, v.record->follow.of);
    v.record->halted = 0;
  }
}

}  // namespace brainshift::solve::device
