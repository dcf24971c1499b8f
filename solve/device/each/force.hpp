// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/cluster_force.hpp"
#include "solve/device/each/team.hpp"

namespace brainshift::solve::device {

// Internal forces in four passes with all threads together between them: points, points again, slots, nodes.

/// Of a member where all are neo-Hookean: from a table of which a warp reads whole lines.
template <class Scalar>
BRAINSHIFT_ON_DEVICE NeoHookean plain_law(const ViewOfEach<Scalar>& v, std::int32_t material, int member) {
  NeoHookean law = v.law[at_member(material, 0)].neo_hookean;
  law.shear_modulus = v.shear_modulus[at_member(material, member)];
  law.bulk_modulus = v.bulk_modulus[at_member(material, member)];
  return law;
}

/// What `asked` returns of a member's law.
template <class Scalar, class Asked>
BRAINSHIFT_ON_DEVICE auto ask_law(const ViewOfEach<Scalar>& v, std::int32_t material, int member, const Asked& asked) {
  return v.is_plain[material] != 0 ? asked(plain_law(v, material, member))
                                   : visit(v.law[at_member(material, member)], asked);
}

/// ψ of a point.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double mode_of(const ViewOfEach<Scalar>& v, std::int32_t point, int mode) {
  if (v.mode == nullptr) {
    return mode == 0 ? 1 / std::sqrt(v.volume[point]) : 0;
  }
  return v.mode[4 * static_cast<std::int64_t>(point) + mode];
}

/// F − 1, column-major. û is taken less that of the point's first node: single precision keeps its digits.
template <class Scalar>
BRAINSHIFT_ON_DEVICE void find_gradient(const ViewOfEach<Scalar>& v, std::int32_t point, int member, const double* u,
                                        Scalar (&h)[9]) {
  const std::int64_t first = v.pair_begin[point], end = v.pair_begin[point + 1];
  const double* of_member = u + member;
  const double* reference = of_member + at_member(3 * static_cast<std::int64_t>(v.pair[first].other), 0);
  const double origin[3] = {reference[0], reference[most_members], reference[2 * most_members]};
  for (Scalar& entry : h) {
    entry = 0;
  }
  BRAINSHIFT_AHEAD
  for (std::int64_t k = first; k < end; ++k) {
    const Pair<Scalar> pair = v.pair[k];
    const double* of_node = of_member + at_member(3 * static_cast<std::int64_t>(pair.other), 0);
    BRAINSHIFT_UNROLLED
    for (int row = 0; row < 3; ++row) {
      const auto moved = static_cast<Scalar>(of_node[row * most_members] - origin[row]);
      BRAINSHIFT_UNROLLED
      for (int axis = 0; axis < 3; ++axis) {
        h[3 * axis + row] += moved * pair.derivative[axis];
      }
    }
  }
}

/// F from F − 1 as it is kept; stride: between two entries.
template <class Scalar>
BRAINSHIFT_ON_DEVICE Deformation deformation_of(const Scalar* tensor, int stride) {
  Eigen::Matrix3d f;
  BRAINSHIFT_UNROLLED
  for (int k = 0; k < 9; ++k) {
    f.data()[k] = (k % 4 == 0 ? 1.0 : 0.0) + static_cast<double>(tensor[k * stride]);
  }
  return Deformation(f);
}

template <class Scalar>
BRAINSHIFT_ON_DEVICE Deformation deformation_at(const ViewOfEach<Scalar>& v, std::int32_t point, int member) {
  return deformation_of(v.tensor + at_member(9 * static_cast<std::int64_t>(point), member), most_members);
}

/// F − 1 of all points, and Σ w ψ θ of the pieces. minus_smallest: of the J that the thread has met.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_dilatations(const Team& team, const ViewOfEach<Scalar>& v, Members who, const double* u,
                                           double (&minus_smallest)[Team::own]) {
  for (std::int32_t i = first_of_each(team); i < v.pieces; i += all_of_each(team)) {
    const Piece piece = v.piece[i];
    const std::int32_t material = v.patch[piece.patch].material;
    team.for_each(who, [&](int m) {
      double seen[4] = {};
      for (std::int32_t p = piece.first_point; p < piece.first_point + piece.points; ++p) {
        Scalar h[9];
        find_gradient(v, p, m, u, h);
        Scalar* tensor = v.tensor + at_member(9 * static_cast<std::int64_t>(p), m);
        BRAINSHIFT_UNROLLED
        for (int k = 0; k < 9; ++k) {
          tensor[k * most_members] = h[k];
        }
        const Deformation d = deformation_of(h, 1);
        minus_smallest[m % Team::own] = larger(minus_smallest[m % Team::own], -d.jacobian);
        const double dilatation = ask_law(v, material, m, [&](const auto& law) { return law.dilatation(d); });
        for (int mode = 0; mode < 4; ++mode) {
          seen[mode] += v.volume[p] * dilatation * mode_of(v, p, mode);
        }
      }
      for (int mode = 0; mode < 4; ++mode) {
        v.seen[at_member(4 * static_cast<std::int64_t>(i) + mode, m)] = seen[mode];
      }
    });
  }
}

/// Σ w ψ θ of a patch, from its pieces in their order.
struct SeenByPatch {
  double of[4] = {};

  template <class Scalar>
  BRAINSHIFT_ON_DEVICE SeenByPatch(const ViewOfEach<Scalar>& v, const PatchOfPieces& patch, int member) {
    BRAINSHIFT_AHEAD
    for (std::int64_t i = patch.first_piece; i < patch.first_piece + patch.pieces; ++i) {
      BRAINSHIFT_UNROLLED
      for (int mode = 0; mode < 4; ++mode) {
        of[mode] += v.seen[at_member(4 * i + mode, member)];
      }
    }
  }

  /// θ̄ at a point of the patch.
  template <class Scalar>
  BRAINSHIFT_ON_DEVICE double at(const ViewOfEach<Scalar>& v, std::int32_t point) const {
    double sum = 0;
    for (int mode = 0; mode < 4; ++mode) {
      sum += of[mode] * mode_of(v, point, mode);
    }
    return sum;
  }
};

/// P where not all members are neo-Hookean.
BRAINSHIFT_ON_DEVICE BRAINSHIFT_APART inline Eigen::Matrix3d stress_of_any(const Law& law, const Deformation& d,
                                                                           double seen) {
  return visit(law, [&](const auto& of) { return stress_of(of, d, seen); });
}

/// w P in the place of F − 1.
template <class Scalar>
BRAINSHIFT_ON_DEVICE void find_stress(const ViewOfEach<Scalar>& v, std::int32_t material, std::int32_t point,
                                      int member, double seen) {
  const Deformation d = deformation_at(v, point, member);
  const Eigen::Matrix3d stress = v.is_plain[material] != 0 ? stress_of(plain_law(v, material, member), d, seen)
                                                           : stress_of_any(v.law[at_member(material, member)], d, seen);
  Scalar* tensor = v.tensor + at_member(9 * static_cast<std::int64_t>(point), member);
  BRAINSHIFT_UNROLLED
  for (int k = 0; k < 9; ++k) {
    tensor[k * most_members] = static_cast<Scalar>(v.volume[point] * stress.data()[k]);
  }
}

/// After find_dilatations() and a sync_all(). A group has the pieces that it had there.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_stresses(const Team& team, const ViewOfEach<Scalar>& v, Members who) {
  for (std::int32_t i = first_of_each(team); i < v.pieces; i += all_of_each(team)) {
    const Piece piece = v.piece[i];
    const PatchOfPieces patch = v.patch[piece.patch];
    team.for_each(who, [&](int m) {
      const SeenByPatch seen(v, patch, m);
      for (std::int32_t p = piece.first_point; p < piece.first_point + piece.points; ++p) {
        find_stress(v, patch.material, p, m, seen.at(v, p));
      }
    });
  }
}

/// Σ w P B of the slots. After find_stresses() and a sync_all().
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_slot_forces(const Team& team, const ViewOfEach<Scalar>& v, Members who) {
  for (std::int32_t share = team.block(); share < v.shares; share += team.blocks()) {
    for (std::int32_t s = v.share_begin[share] + team.group(); s < v.share_begin[share + 1]; s += team.groups()) {
      const std::int64_t first = v.slot_begin[s], end = v.slot_begin[s + 1];
      team.for_each(who, [&](int m) {
        Scalar sum[3] = {};
        BRAINSHIFT_AHEAD
        for (std::int64_t k = first; k < end; ++k) {
          const Pair<Scalar> pair = v.slot_pair[k];
          const Scalar* tensor = v.tensor + at_member(9 * static_cast<std::int64_t>(pair.other), m);
          BRAINSHIFT_UNROLLED
          for (int axis = 0; axis < 3; ++axis) {
            BRAINSHIFT_UNROLLED
            for (int row = 0; row < 3; ++row) {
              sum[row] += tensor[(3 * axis + row) * most_members] * pair.derivative[axis];
            }
          }
        }
        for (int row = 0; row < 3; ++row) {
          v.slot_force[at_member(3 * static_cast<std::int64_t>(s) + row, m)] = sum[row];
        }
      });
    }
  }
}

/// f_int at a node, from its slots in their order, µN. After find_slot_forces() and a sync_all().
template <class Scalar>
BRAINSHIFT_ON_DEVICE void sum_slot_forces(const ViewOfEach<Scalar>& v, std::int32_t node, int member,
                                          double (&force)[3]) {
  for (double& component : force) {
    component = 0;
  }
  BRAINSHIFT_AHEAD
  for (std::int64_t k = v.node_begin[node]; k < v.node_begin[node + 1]; ++k) {
    const Scalar* of_slot = v.slot_force + at_member(3 * static_cast<std::int64_t>(v.node_slot[k]), member);
    BRAINSHIFT_UNROLLED
    for (int row = 0; row < 3; ++row) {
      force[row] += static_cast<double>(of_slot[row * most_members]);
    }
  }
}

}  // namespace brainshift::solve::device
