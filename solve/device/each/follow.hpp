// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/each/step.hpp"
#include "solve/device/follow.hpp"

namespace brainshift::solve::device {

// The bound D of the stiffness of each member as stiffness_bound() has it, in passes as in ../follow.hpp.

/// A SharedBound among those of a member.
BRAINSHIFT_ON_DEVICE inline SharedBound read_bound(const double* bounds, std::int64_t i, int member) {
  return {.scale = bounds[at_member(3 * i, member)],
          .per_firmness = bounds[at_member(3 * i + 1, member)],
          .least = bounds[at_member(3 * i + 2, member)]};
}
BRAINSHIFT_ON_DEVICE inline void write_bound(const SharedBound& bound, double* bounds, std::int64_t i, int member) {
  bounds[at_member(3 * i, member)] = bound.scale;
  bounds[at_member(3 * i + 1, member)] = bound.per_firmness;
  bounds[at_member(3 * i + 2, member)] = bound.least;
}

/// How nodes share a bound, as NodeShares has it: firmness(k) and reach(k) of those in [first, end).
template <class Firmness, class Reach>
BRAINSHIFT_ON_DEVICE SharedBound shared_by(std::int64_t first, std::int64_t end, const Firmness& firmness,
                                           const Reach& reach) {
  double firmest = 0;
  for (std::int64_t k = first; k < end; ++k) {
    firmest = larger(firmest, firmness(k));
  }
  SharedBound bound{.scale = 0, .per_firmness = 1 / firmest, .least = 1};
  double soft = 0, all = 0;
  for (std::int64_t k = first; k < end; ++k) {
    const double of_node = reach(k);
    soft += of_node * (1 - firmness(k) * bound.per_firmness);
    all += of_node;
  }
  bound.least = all > 0 ? soft / all : 1;
  return bound;
}

/// ‖Σ B ⊗ B / (h |B|)‖ of a point, and how its nodes share it.
template <class Scalar>
BRAINSHIFT_ON_DEVICE SharedBound norm_at(const ViewOfEach<Scalar>& v, std::int32_t point, int member) {
  const std::int64_t first = v.pair_begin[point], end = v.pair_begin[point + 1];
  const auto firmness = [&](std::int64_t k) { return v.firmness[at_member(v.pair[k].other, member)]; };
  SharedBound bound = shared_by(first, end, firmness, [&](std::int64_t k) { return length(v.pair[k]); });
  double upper[6] = {};
  for (std::int64_t k = first; k < end; ++k) {
    const Pair<Scalar> pair = v.pair[k];
    const double reach = length(pair), share = share_of(bound, firmness(k));
    const double weight = reach > 0 ? 1 / (share * reach) : 0;
    const double b[3] = {static_cast<double>(pair.derivative[0]), static_cast<double>(pair.derivative[1]),
                         static_cast<double>(pair.derivative[2])};
    BRAINSHIFT_UNROLLED
    for (int n = 0; n < 3; ++n) {
      upper[n] += weight * b[0] * b[n];
    }
    upper[3] += weight * b[1] * b[1];
    upper[4] += weight * b[1] * b[2];
    upper[5] += weight * b[2] * b[2];
  }
  Eigen::Matrix3d sum;
  sum << upper[0], upper[1], upper[2], upper[1], upper[3], upper[4], upper[2], upper[4], upper[5];
  bound.scale = symmetric_eigenvalues(sum)[2];
  return bound;
}

/// w C of the change of shape.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double tangent_at(const ViewOfEach<Scalar>& v, std::int32_t material, std::int32_t point,
                                       int member, double seen) {
  const Deformation d = deformation_at(v, point, member);
  return v.volume[point] * ask_law(v, material, member, [&](const auto& law) {
           const double dilatation = law.dilatation(d);
           return shape_tangent(law, d.gradient, point_pressure(law, seen, dilatation), dilatation);
         });
}

template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_point_bounds(const Team& team, const ViewOfEach<Scalar>& v, Members who) {
  for (std::int32_t i = first_of_each(team); i < v.pieces; i += all_of_each(team)) {
    const Piece piece = v.piece[i];
    const PatchOfPieces patch = v.patch[piece.patch];
    team.for_each(who, [&](int m) {
      const SeenByPatch seen(v, patch, m);
      for (std::int32_t p = piece.first_point; p < piece.first_point + piece.points; ++p) {
        SharedBound bound = norm_at(v, p, m);
        bound.scale *= tangent_at(v, patch.material, p, m, seen.at(v, p));
        write_bound(bound, v.point_bound, p, m);
      }
    });
  }
}

/// Σ w ψ ∂θ/∂F B of each mode, of the nodes and the patches that touch them.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_touches(const Team& team, const ViewOfEach<Scalar>& v, Members who) {
  for (std::int64_t i = first_of_each(team); i < v.touches; i += all_of_each(team)) {
    const Touch one = v.touch[i];
    const std::int32_t material = v.patch[one.patch].material;
    team.for_each(who, [&](int m) {
      Eigen::Matrix<double, 3, 4> sum = Eigen::Matrix<double, 3, 4>::Zero();
      for (std::int64_t k = one.first; k < one.first + one.pairs; ++k) {
        const Pair<Scalar> pair = v.slot_pair[k];
        const std::int32_t point = pair.other;
        const Deformation d = deformation_at(v, point, m);
        const Eigen::Vector3d b(static_cast<double>(pair.derivative[0]), static_cast<double>(pair.derivative[1]),
                                static_cast<double>(pair.derivative[2]));
        const Eigen::Vector3d slope = ask_law(v, material, m, [&](const auto& law) -> Eigen::Vector3d {
          return v.volume[point] * (law.dilatation_slope(d) * b);
        });
        BRAINSHIFT_UNROLLED
        for (int mode = 0; mode < 4; ++mode) {
          sum.col(mode) += mode_of(v, point, mode) * slope;
        }
      }
      BRAINSHIFT_UNROLLED
      for (int mode = 0; mode < 4; ++mode) {
        v.touch_norm[at_member(4 * i + mode, m)] = sum.col(mode).norm();
      }
    });
  }
}

/// K and Σ |b|/h of each mode of the patches, and how their nodes share it.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_totals(const Team& team, const ViewOfEach<Scalar>& v, Members who) {
  for (std::int32_t i = first_of_each(team); i < v.patches; i += all_of_each(team)) {
    const std::int64_t begin = v.patch_touch_begin[i], end = v.patch_touch_begin[i + 1];
    const std::int32_t material = v.patch[i].material;
    team.for_each(who, [&](int m) {
      const auto firmness = [&](std::int64_t k) { return v.firmness[at_member(v.patch_touch_node[k], m)]; };
      SharedBound bound =
          shared_by(begin, end, firmness, [&](std::int64_t k) { return v.touch_reach[v.patch_touch[k]]; });
      bound.scale = v.bulk_modulus[at_member(material, m)];
      double total[4] = {};
      for (std::int64_t k = begin; k < end; ++k) {
        const double share = share_of(bound, firmness(k));
        BRAINSHIFT_UNROLLED
        for (int mode = 0; mode < 4; ++mode) {
          total[mode] += v.touch_norm[at_member(4 * v.patch_touch[k] + mode, m)] / share;
        }
      }
      write_bound(bound, v.patch_bound, i, m);
      BRAINSHIFT_UNROLLED
      for (int mode = 0; mode < 4; ++mode) {
        v.patch_total[at_member(4 * static_cast<std::int64_t>(i) + mode, m)] = total[mode];
      }
    });
  }
}

template <class Scalar>
BRAINSHIFT_ON_DEVICE double bound_of_slot(const ViewOfEach<Scalar>& v, std::int32_t slot, int member) {
  const double firmness = v.firmness[at_member(v.slot_node[slot], member)];
  double sum = 0;
  for (std::int64_t k = v.slot_begin[slot]; k < v.slot_begin[slot + 1]; ++k) {
    const SharedBound bound = read_bound(v.point_bound, v.slot_pair[k].other, member);
    sum += bound.scale * share_of(bound, firmness) * length(v.slot_pair[k]);
  }
  for (std::int64_t k = v.touch_begin[slot]; k < v.touch_begin[slot + 1]; ++k) {
    const std::int64_t patch = v.touch[k].patch;
    const SharedBound bound = read_bound(v.patch_bound, patch, member);
    double both = 0;
    BRAINSHIFT_UNROLLED
    for (int mode = 0; mode < 4; ++mode) {
      both += v.patch_total[at_member(4 * patch + mode, member)] * v.touch_norm[at_member(4 * k + mode, member)];
    }
    sum += bound.scale * share_of(bound, firmness) * both;
  }
  return sum;
}

template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_slot_bounds(const Team& team, const ViewOfEach<Scalar>& v, Members who) {
  for (std::int32_t s = first_of_each(team); s < v.slots; s += all_of_each(team)) {
    team.for_each(who, [&](int m) { v.slot_bound[at_member(s, m)] = bound_of_slot(v, s, m); });
  }
}

/// The masses that the stiffness at the last force wants, and of whom it wants others than there are.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void follow_stiffness(const Team& team, const ViewOfEach<Scalar>& v, const OrderOfEach& order,
                                           const MotionOfEach& motion) {
  double minus_smallest[Team::own] = {};
  find_dilatations(team, v, order.who, motion.before, minus_smallest);
  team.sync_all();
  find_point_bounds(team, v, order.who);
  find_touches(team, v, order.who);
  team.sync_all();
  find_totals(team, v, order.who);
  team.sync_all();
  find_slot_bounds(team, v, order.who);
  team.sync_all();
  Gathered<Team, 1> stiffer;
  for (std::int32_t a = first_of_each(team); a < v.nodes; a += all_of_each(team)) {
    team.for_each(order.who, [&](int m) {
      double bound = 0;
      for (std::int64_t k = v.node_begin[a]; k < v.node_begin[a + 1]; ++k) {
        bound += v.slot_bound[at_member(v.node_slot[k], m)];
      }
      const std::int64_t i = at_member(a, m);
      const double mass = v.mass[i], wanted = order.mass_scale[m] * bound;
      v.stiffer_mass[i] = std::max(mass, order.mass_margin * wanted);
      stiffer.at(0, m) = larger(stiffer.at(0, m), wanted / mass);
    });
  }
  leave_each<0>(team, stiffer, v.partial);
  team.sync_all();
  if (team.block() == 0) {
    collect_each<0, 1>(team, order.who, v.partial, [&](int, int m, double x) { v.record->stiffer[m] = x; });
    if (team.group() == 0 && team.leads()) {
      v.record->halted = 0;
    }
  }
}

}  // namespace brainshift::solve::device
