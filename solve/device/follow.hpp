// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/node_step.hpp"

namespace brainshift::solve::device {

// The bound D of the stiffness as stiffness_bound() has it, here in four passes: the points, the patches' nodes, the
// patches, the slots. Nodes share a bound by NodeShares; how they do, and what else does not depend on the state, is
// found once for each body.

/// g of a node, one of the cluster's slots.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double firmness_of(const View<Scalar>& v, std::int64_t slot) {
  return v.firmness[v.slot_node[slot]];
}

BRAINSHIFT_ON_DEVICE inline double share_of(const SharedBound& bound, double firmness) {
  return std::max(firmness * bound.per_firmness, bound.least);
}

template <class Scalar>
BRAINSHIFT_ON_DEVICE double length(const Pair<Scalar>& pair) {
  Scalar square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    square += pair.derivative[axis] * pair.derivative[axis];
  }
  return static_cast<double>(std::sqrt(square));
}

/// w C of the change of shape.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double tangent_at(const View<Scalar>& v, const Cluster& c, const Room<Scalar>& room,
                                       std::int32_t p) {
  const std::int32_t point = c.first_point + p;
  const Deformation d(room.gradient(p));
  const double seen = seen_at(v, c, room, point);
  return v.volume[point] * visit(v.law[v.material[point]], [&](const auto& law) {
           const double dilatation = law.dilatation(d);
           return shape_tangent(law, d.gradient, point_pressure(law, seen, dilatation), dilatation);
         });
}

/// How nodes share a bound, as NodeShares has it, by the lanes that go through them: firmness(k) and reach(k) of those
/// from `first` on. Each lane has all of it.
template <int lanes, class Team, class Firmness, class Reach>
BRAINSHIFT_ON_DEVICE SharedBound shared_by(const Team& team, std::int64_t first, std::int64_t end,
                                           const Firmness& firmness, const Reach& reach) {
  double firmest = 0;
  for (std::int64_t k = first; k < end; k += lanes) {
    firmest = larger(firmest, firmness(k));
  }
  SharedBound bound{.scale = 0, .per_firmness = 1 / team.template largest<lanes>(firmest), .least = 1};
  double soft = 0, all = 0;
  for (std::int64_t k = first; k < end; k += lanes) {
    const double of_node = reach(k);
    soft += of_node * (1 - firmness(k) * bound.per_firmness);
    all += of_node;
  }
  soft = team.template sum<lanes>(soft);
  all = team.template sum<lanes>(all);
  bound.least = all > 0 ? soft / all : 1;
  return bound;
}

/// ‖Σ B ⊗ B / (h |B|)‖ of a point, in its place of the slices, and how its nodes share it; each lane has all of it.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE SharedBound norm_at(const Team& team, const View<Scalar>& v, const Cluster& c, std::int32_t slice,
                                         std::int32_t of_slice) {
  constexpr int lanes = Team::lanes;
  const std::int64_t turn = v.turn_begin[slice], end = slice_lanes * (v.turn_begin[slice + 1] - turn);
  const auto pair_at = [&](std::int64_t k) {
    return v.slice_pair[((turn + k / slice_lanes) * slice_points + of_slice) * slice_lanes + k % slice_lanes];
  };
  const auto firmness = [&](std::int64_t k) {
    const Pair<Scalar> pair = pair_at(k);
    return length(pair) > 0 ? firmness_of(v, c.first_slot + pair.other) : 0;
  };
  const std::int64_t first = team.thread() % lanes;
  SharedBound bound = shared_by<lanes>(team, first, end, firmness, [&](std::int64_t k) { return length(pair_at(k)); });
  double upper[6] = {};
  for (std::int64_t k = first; k < end; k += lanes) {
    const Pair<Scalar> pair = pair_at(k);
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

/// What no state changes: the norms of the points, Σ w |B| of the touches, and how nodes share the bounds.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void share_bounds(const Team& team, const View<Scalar>& v) {
  constexpr int lanes = Team::lanes, wide = Team::wide;
  for (int i = team.block(); i < v.clusters; i += team.blocks()) {
    const Cluster& c = v.cluster[i];
    const std::int32_t slice = v.slice_begin[i], places = slice_points * (v.slice_begin[i + 1] - slice);
    for (std::int32_t place = team.thread() / lanes; place < places; place += team.threads() / lanes) {
      const std::int32_t p = v.slice_point[slice_points * slice + place];
      const SharedBound bound = norm_at(team, v, c, slice + place / slice_points, place % slice_points);
      if (p >= 0 && team.thread() % lanes == 0) {
        v.point_bound[c.first_point + p] = bound;
      }
    }
    const std::int64_t first = v.touch_begin[c.first_slot], last = v.touch_begin[c.first_slot + c.slots];
    for (std::int64_t k = first + team.thread(); k < last; k += team.threads()) {
      const Touch& touch = v.touch[k];
      double reach = 0;
      for (std::int64_t at = touch.first; at < touch.first + touch.pairs; ++at) {
        reach += v.volume[c.first_point + v.slot_pair[at].other] * length(v.slot_pair[at]);
      }
      v.touch_reach[k] = reach;
    }
    team.sync_block();
    for (std::int32_t k = team.thread() / wide; k < c.patches; k += team.threads() / wide) {
      const std::int32_t patch = c.first_patch + k;
      SharedBound bound = shared_by<wide>(
          team, v.patch_touch_begin[patch] + team.thread() % wide, v.patch_touch_begin[patch + 1],
          [&](std::int64_t at) { return v.firmness[v.patch_touch_node[at]]; },
          [&](std::int64_t at) { return v.touch_reach[v.patch_touch[at]]; });
      bound.scale = visit(v.law[v.patch[patch].material], [](const auto& law) { return law.bulk_modulus; });
      if (team.thread() % wide == 0) {
        v.patch_bound[patch] = bound;
      }
    }
    team.sync_block();
  }
}

/// Leaves w ∂θ/∂F of a point where its F was.
template <class Scalar>
BRAINSHIFT_ON_DEVICE void find_slope(const View<Scalar>& v, const Cluster& c, const Room<Scalar>& room,
                                     std::int32_t p) {
  const std::int32_t point = c.first_point + p;
  const Deformation d(room.gradient(p));
  const Eigen::Matrix3d slope = visit(v.law[v.material[point]], [&](const auto& law) -> Eigen::Matrix3d {
    return v.volume[point] * law.dilatation_slope(d);
  });
  for (int k = 0; k < 9; ++k) {
    room.tensor[k * room.points + p] = static_cast<Scalar>(slope.data()[k]);
  }
}

/// |Σ w ψ ∂θ/∂F B| of each mode, of a node and a patch that touches it, by the lanes.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_touch(const Team& team, const View<Scalar>& v, const Cluster& c,
                                     const Room<Scalar>& room, std::int64_t at) {
  constexpr int lanes = Team::lanes;
  const Touch touch = v.touch[at];
  double sum[4][3] = {};
  for (std::int64_t k = touch.first + team.thread() % lanes; k < touch.first + touch.pairs; k += lanes) {
    const Pair<Scalar> pair = v.slot_pair[k];
    const Scalar* slope = room.tensor + pair.other;
    for (int row = 0; row < 3; ++row) {
      double of_pair = 0;
      for (int axis = 0; axis < 3; ++axis) {
        of_pair +=
            static_cast<double>(slope[(3 * axis + row) * room.points]) * static_cast<double>(pair.derivative[axis]);
      }
      BRAINSHIFT_UNROLLED
      for (int mode = 0; mode < 4; ++mode) {
        sum[mode][row] += mode_of(v, c.first_point + pair.other, mode) * of_pair;
      }
    }
  }
  BRAINSHIFT_UNROLLED
  for (int mode = 0; mode < 4; ++mode) {
    double square = 0;
    for (int row = 0; row < 3; ++row) {
      const double all = team.template sum<lanes>(sum[mode][row]);
      square += all * all;
    }
    if (mode % lanes == team.thread() % lanes) {
      v.touch_norm[at].of[mode] = std::sqrt(square);
    }
  }
}

/// Σ |b|/h of each mode of a patch.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_total(const Team& team, const View<Scalar>& v, std::int32_t patch) {
  constexpr int wide = Team::wide;
  const SharedBound bound = v.patch_bound[patch];
  double total[4] = {};
  for (std::int64_t k = v.patch_touch_begin[patch] + team.thread() % wide; k < v.patch_touch_begin[patch + 1];
       k += wide) {
    const double share = share_of(bound, v.firmness[v.patch_touch_node[k]]);
    for (int mode = 0; mode < 4; ++mode) {
      total[mode] += v.touch_norm[v.patch_touch[k]].of[mode] / share;
    }
  }
  for (int mode = 0; mode < 4; ++mode) {
    total[mode] = team.template sum<wide>(total[mode]);
  }
  if (team.thread() % wide == 0) {
    for (int mode = 0; mode < 4; ++mode) {
      v.patch_total[patch].of[mode] = total[mode];
    }
  }
}

/// For each of the lanes that have the slot.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE double bound_of_slot(const Team& team, const View<Scalar>& v, const Cluster& c,
                                          std::int64_t slot) {
  constexpr int lanes = Team::lanes;
  const double firmness = firmness_of(v, slot);
  double sum = 0;
  BRAINSHIFT_AHEAD
  for (std::int64_t k = v.slot_begin[slot] + team.thread() % lanes; k < v.slot_begin[slot + 1]; k += lanes) {
    const std::int32_t point = c.first_point + v.slot_pair[k].other;
    const SharedBound& bound = v.point_bound[point];
    sum += v.point_tangent[point] * bound.scale * share_of(bound, firmness) * length(v.slot_pair[k]);
  }
  for (std::int64_t k = v.touch_begin[slot] + team.thread() % lanes; k < v.touch_begin[slot + 1]; k += lanes) {
    const std::int32_t patch = v.touch[k].patch;
    const SharedBound& bound = v.patch_bound[patch];
    for (int mode = 0; mode < 4; ++mode) {
      sum += bound.scale * share_of(bound, firmness) * v.patch_total[patch].of[mode] * v.touch_norm[k].of[mode];
    }
  }
  return team.template sum<lanes>(sum);
}

/// `slot_bound` at the state u. Returns as find_dilatations().
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE double find_slot_bounds(const Team& team, const View<Scalar>& v, const double* u) {
  constexpr int lanes = Team::lanes, wide = Team::wide;
  const Room<Scalar> room(team.room(), v);
  double minus_smallest = -std::numeric_limits<double>::infinity();
  for (int i = team.block(); i < v.clusters; i += team.blocks()) {
    const Cluster& c = v.cluster[i];
    find_gradients(team, v, i, u, 1, room);
    minus_smallest = larger(minus_smallest, find_dilatations(team, v, c, room));
    for (std::int32_t p = team.thread(); p < c.points; p += team.threads()) {
      v.point_tangent[c.first_point + p] = tangent_at(v, c, room, p);
      find_slope(v, c, room, p);
    }
    team.sync_block();
    const std::int64_t first = v.touch_begin[c.first_slot], last = v.touch_begin[c.first_slot + c.slots];
    for (std::int64_t k = first + team.thread() / lanes; k < last; k += team.threads() / lanes) {
      find_touch(team, v, c, room, k);
    }
    team.sync_block();
    for (std::int32_t k = team.thread() / wide; k < c.patches; k += team.threads() / wide) {
      find_total(team, v, c.first_patch + k);
    }
    team.sync_block();
    for (std::int32_t s = team.thread() / lanes; s < c.slots; s += team.threads() / lanes) {
      const double bound = bound_of_slot(team, v, c, c.first_slot + s);
      if (team.thread() % lanes == 0) {
        v.slot_bound[c.first_slot + s] = bound;
      }
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
    of[FollowSums::stiffer] = larger(of[FollowSums::stiffer], order.mass_scale * bound / mass);
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
