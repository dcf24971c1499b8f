// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <type_traits>

#include "solve/device/team.hpp"
#include "solve/device/view.hpp"
#include "solve/force/point_pressure.hpp"

namespace brainshift::solve::device {

/// What a block holds of the cluster that it has in hand.
template <class Scalar>
struct Room {
  using Whole = std::conditional_t<std::is_same_v<Scalar, float>, std::int32_t, std::int64_t>;

  SlotVector<Scalar>* displacement;  ///< û less that of the cluster's first node: single precision keeps its digits
  Pair<Scalar>* pair;                ///< of the first turns, which stay from step to step
  double* dilatation;                ///< w θ of the points
  double* seen;                      ///< Σ w ψ θ of the patches, 4 each
  std::uint64_t* largest;            ///< rising_key() of |w P| and of −J
  Whole* force;                      ///< of the slots, x of all, then y, then z, in parts of the largest there can be
  Scalar* tensor;                    ///< of the points: F − 1, then w P; entry by entry
  std::int32_t points, slots;        ///< between two entries of a tensor and of a force
  std::int32_t resident = 0;         ///< turns that are there

  /// Bytes that it takes.
  static std::size_t size(std::int32_t slots, std::int32_t points, std::int32_t patches, std::int32_t turns) {
    return static_cast<std::size_t>(slots) * (sizeof(SlotVector<Scalar>) + 3 * sizeof(Whole)) + turn_size(turns) +
           static_cast<std::size_t>(points) * (9 * sizeof(Scalar) + sizeof(double)) +
           (static_cast<std::size_t>(patches) * 4 + 2) * sizeof(double);
  }
  static std::size_t size(const View<Scalar>& v) {
    return size(v.most_slots, v.most_points, v.most_patches, v.resident);
  }
  static std::size_t turn_size(std::int32_t turns) {
    return static_cast<std::size_t>(turns) * slice_points * slice_lanes * sizeof(Pair<Scalar>);
  }

  BRAINSHIFT_ON_DEVICE Room(std::byte* memory, const View<Scalar>& v)
      : displacement(reinterpret_cast<SlotVector<Scalar>*>(memory)), points(v.most_points), slots(v.most_slots) {
    pair = reinterpret_cast<Pair<Scalar>*>(displacement + slots);
    dilatation = reinterpret_cast<double*>(pair + v.resident * slice_points * slice_lanes);
    seen = dilatation + points;
    largest = reinterpret_cast<std::uint64_t*>(seen + 4 * v.most_patches);
    force = reinterpret_cast<Whole*>(largest + 2);
    tensor = reinterpret_cast<Scalar*>(force + 3 * slots);
  }

  BRAINSHIFT_ON_DEVICE Eigen::Matrix3d gradient(std::int32_t p) const {
    Eigen::Matrix3d f;
    for (int k = 0; k < 9; ++k) {
      f.data()[k] = (k % 4 == 0 ? 1.0 : 0.0) + static_cast<double>(tensor[k * points + p]);
    }
    return f;
  }
};

/// ψ of a point.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double mode_of(const View<Scalar>& v, std::int32_t point, int mode) {
  if (v.mode == nullptr) {
    return mode == 0 ? 1 / std::sqrt(v.volume[point]) : 0;
  }
  return v.mode[4 * static_cast<std::int64_t>(point) + mode];
}

/// Where a block has one cluster alone, keeps its first pairs.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void keep_pairs(const Team& team, const View<Scalar>& v, Room<Scalar>& room) {
  if (v.clusters > team.blocks() || team.block() >= v.clusters) {
    return;
  }
  const std::int32_t* slices = v.slice_begin + team.block();
  const std::int64_t first = v.turn_begin[slices[0]], last = v.turn_begin[slices[1]];
  constexpr int each = slice_points * slice_lanes;
  room.resident = static_cast<std::int32_t>(std::min<std::int64_t>(v.resident, last - first));
  for (std::int32_t k = team.thread(); k < room.resident * each; k += team.threads()) {
    room.pair[k] = v.slice_pair[first * each + k];
  }
  team.sync_block();
}

/// Goes through the slices of a cluster: begin(p), give(pair) for the lane's pairs, end(p), by the lanes that have
/// point p of the cluster; p is −1 in the empty places of a slice.
template <class Team, class Scalar, class Begin, class Give, class End>
BRAINSHIFT_ON_DEVICE void for_slices(const Team& team, const View<Scalar>& v, std::int32_t cluster,
                                     const Room<Scalar>& room, const Begin& begin, const Give& give, const End& end) {
  constexpr int lanes = Team::lanes, at_once = Team::template at_once<Scalar>, each = slice_points * slice_lanes;
  const std::int32_t first_slice = v.slice_begin[cluster], slices = v.slice_begin[cluster + 1] - first_slice;
  const std::int64_t first = v.turn_begin[first_slice];
  const Pair<Scalar>* pairs = v.slice_pair + first * each;
  for (std::int32_t place = team.thread() / lanes; place < slices * slice_points; place += team.threads() / lanes) {
    const std::int64_t* turns = v.turn_begin + first_slice + place / slice_points;
    const auto last = static_cast<std::int32_t>(turns[1] - first);
    const std::int32_t p = v.slice_point[first_slice * slice_points + place];
    begin(p);
    for (int lane = team.thread() % lanes; lane < slice_lanes; lane += lanes) {
      const std::int32_t of_turn = place % slice_points * slice_lanes + lane;
      for (auto turn = static_cast<std::int32_t>(turns[0] - first); turn < last; turn += at_once) {
        Pair<Scalar> batch[at_once];
        BRAINSHIFT_UNROLLED
        for (int i = 0; i < at_once; ++i) {
          const std::int32_t k = (turn + i) * each + of_turn;
          if (turn + i >= last) {
            batch[i] = {};
          } else if (turn + i < room.resident) {
            batch[i] = room.pair[k];
          } else {
            batch[i] = pairs[k];
          }
        }
        BRAINSHIFT_UNROLLED
        for (int i = 0; i < at_once; ++i) {
          if (turn + i < last) {
            give(batch[i]);
          }
        }
      }
    }
    end(p);
  }
}

/// F − 1 at the points of a cluster, of the state scale · u.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_gradients(const Team& team, const View<Scalar>& v, std::int32_t cluster, const double* u,
                                         double scale, const Room<Scalar>& room) {
  const Cluster& c = v.cluster[cluster];
  const std::int32_t* node = v.slot_node + c.first_slot;
  const double* reference = u + 4 * static_cast<std::int64_t>(node[0]);
  BRAINSHIFT_AHEAD
  for (std::int32_t s = team.thread(); s < c.slots; s += team.threads()) {
    const double* of_node = u + 4 * static_cast<std::int64_t>(node[s]);
    SlotVector<Scalar> displacement = {};
    for (int axis = 0; axis < 3; ++axis) {
      displacement.of[axis] = static_cast<Scalar>(scale * (of_node[axis] - reference[axis]));
    }
    room.displacement[s] = displacement;
  }
  team.sync_block();
  constexpr int lanes = Team::lanes;
  Scalar sum[9];
  for_slices(
      team, v, cluster, room,
      [&](std::int32_t) {
        BRAINSHIFT_UNROLLED
        for (int k = 0; k < 9; ++k) {
          sum[k] = 0;
        }
      },
      [&](const Pair<Scalar>& pair) {
        const SlotVector<Scalar> of_node = room.displacement[pair.other];
        BRAINSHIFT_UNROLLED
        for (int axis = 0; axis < 3; ++axis) {
          BRAINSHIFT_UNROLLED
          for (int row = 0; row < 3; ++row) {
            sum[3 * axis + row] += of_node.of[row] * pair.derivative[axis];
          }
        }
      },
      [&](std::int32_t p) {
        const int lane = team.thread() % lanes;
        BRAINSHIFT_UNROLLED
        for (int k = 0; k < 9; ++k) {
          const Scalar all = team.template sum<lanes>(sum[k]);
          if (k % lanes == lane && p >= 0) {
            room.tensor[k * room.points + p] = all;
          }
        }
      });
  team.sync_block();
}

/// θ of a law that few bodies have. gradient: F, a copy, so that the others' F stays in registers.
BRAINSHIFT_ON_DEVICE BRAINSHIFT_APART inline double dilatation_of_other(const Law& law, Eigen::Matrix3d gradient) {
  const Deformation d(gradient);
  return visit(law, [&](const auto& of) { return of.dilatation(d); });
}

/// w θ at the points, then Σ w ψ θ of the patches. Returns minus the smallest J that the thread has met, at least -1.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE double find_dilatations(const Team& team, const View<Scalar>& v, const Cluster& c,
                                             const Room<Scalar>& room) {
  double minus_smallest = -1;
  for (std::int32_t p = team.thread(); p < c.points; p += team.threads()) {
    const std::int32_t point = c.first_point + p;
    const Deformation d(room.gradient(p));
    minus_smallest = larger(minus_smallest, -d.jacobian);
    const Law& law = v.law[v.material[point]];
    room.dilatation[p] = v.volume[point] * (law.kind == Law::Kind::neo_hookean ? law.neo_hookean.dilatation(d)
                                                                               : dilatation_of_other(law, d.gradient));
  }
  team.sync_block();
  constexpr int wide = Team::wide;
  for (std::int32_t i = team.thread() / wide; i < c.patches; i += team.threads() / wide) {
    const PatchPoints patch = v.patch[c.first_patch + i];
    double seen[4] = {};
    for (std::int32_t p = team.thread() % wide; p < patch.points; p += wide) {
      const std::int32_t point = patch.first_point + p;
      const double dilatation = room.dilatation[point - c.first_point];
      BRAINSHIFT_UNROLLED
      for (int mode = 0; mode < 4; ++mode) {
        seen[mode] += dilatation * mode_of(v, point, mode);
      }
    }
    BRAINSHIFT_UNROLLED
    for (int mode = 0; mode < 4; ++mode) {
      const double all = team.template sum<wide>(seen[mode]);
      if (team.thread() % wide == 0) {
        room.seen[4 * i + mode] = all;
      }
    }
  }
  team.sync_block();
  return minus_smallest;
}

/// θ̄ at a point.
template <class Scalar>
BRAINSHIFT_ON_DEVICE double seen_at(const View<Scalar>& v, const Cluster& c, const Room<Scalar>& room,
                                    std::int32_t point) {
  const double* seen = room.seen + 4 * (v.patch_of[point] - c.first_patch);
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    sum += seen[k] * mode_of(v, point, k);
  }
  return sum;
}

}  // namespace brainshift::solve::device
