// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/team.hpp"
#include "solve/device/view.hpp"
#include "solve/force/point_pressure.hpp"

namespace brainshift::solve::device {

/// What a block holds of the cluster that it has in hand.
template <class Scalar>
struct Room {
  SlotVector<Scalar>* displacement;  ///< û less that of the cluster's first node: single precision keeps its digits
  Scalar* tensor;                    ///< of the points: F − 1, then w P; entry by entry
  double* dilatation;                ///< w ψ θ of the points, of the first mode, then of the others
  double* seen;                      ///< Σ w ψ θ of the patches, 4 each
  std::int32_t points;               ///< between two entries of a tensor

  /// Bytes that it takes.
  static std::size_t size(std::int32_t slots, std::int32_t points) {
    return static_cast<std::size_t>(slots) * sizeof(SlotVector<Scalar>) +
           static_cast<std::size_t>(points) * (9 * sizeof(Scalar) + 8 * sizeof(double)) + 2 * sizeof(double);
  }

  BRAINSHIFT_ON_DEVICE Room(std::byte* memory, std::int32_t most_slots, std::int32_t most_points)
      : displacement(reinterpret_cast<SlotVector<Scalar>*>(memory)), points(most_points) {
    dilatation = reinterpret_cast<double*>(displacement + most_slots);
    seen = dilatation + 4 * most_points;
    tensor = reinterpret_cast<Scalar*>(seen + 4 * most_points);
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

/// F − 1 at the points of a cluster.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_gradients(const Team& team, const View<Scalar>& v, const Cluster& c, const double* u,
                                         const Room<Scalar>& room) {
  const std::int32_t* node = v.slot_node + c.first_slot;
  const double* reference = u + 4 * static_cast<std::int64_t>(node[0]);
  BRAINSHIFT_AHEAD
  for (std::int32_t s = team.thread(); s < c.slots; s += team.threads()) {
    const double* of_node = u + 4 * static_cast<std::int64_t>(node[s]);
    SlotVector<Scalar> displacement = {};
    for (int axis = 0; axis < 3; ++axis) {
      displacement.of[axis] = static_cast<Scalar>(of_node[axis] - reference[axis]);
    }
    room.displacement[s] = displacement;
  }
  team.sync_block();
  constexpr int lanes = Team::lanes;
  const int lane = team.thread() % lanes;
  for (std::int32_t p = team.thread() / lanes; p < c.points; p += team.threads() / lanes) {
    Scalar sum[9] = {};
    const std::int64_t* begin = v.pair_begin + c.first_point + p;
    for_entries(team, v.pair, begin[0], begin[1], [&](const Pair<Scalar>& pair) {
      const SlotVector<Scalar> of_node = room.displacement[pair.other];
      BRAINSHIFT_UNROLLED
      for (int axis = 0; axis < 3; ++axis) {
        BRAINSHIFT_UNROLLED
        for (int row = 0; row < 3; ++row) {
          sum[3 * axis + row] += of_node.of[row] * pair.derivative[axis];
        }
      }
    });
    for (int k = 0; k < 9; ++k) {
      const Scalar all = team.template sum<lanes>(sum[k]);
      if (k % lanes == lane) {
        room.tensor[k * room.points + p] = all;
      }
    }
  }
  team.sync_block();
}

/// w ψ θ at the points, then Σ w ψ θ of the patches. Returns minus the smallest J that the thread has met.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE double find_dilatations(const Team& team, const View<Scalar>& v, const Cluster& c,
                                             const Room<Scalar>& room) {
  double minus_smallest = -1;
  for (std::int32_t p = team.thread(); p < c.points; p += team.threads()) {
    const std::int32_t point = c.first_point + p;
    const Deformation d(room.gradient(p));
    minus_smallest = larger(minus_smallest, -d.jacobian);
    const double dilatation = visit(v.law[v.material[point]], [&](const auto& of) { return of.dilatation(d); });
    for (int mode = 0; mode < 4; ++mode) {
      room.dilatation[mode * room.points + p] = v.volume[point] * dilatation * mode_of(v, point, mode);
    }
  }
  team.sync_block();
  for (std::int32_t i = team.thread(); i < 4 * c.patches; i += team.threads()) {
    const PatchPoints& patch = v.patch[c.first_patch + i / 4];
    const double* of_mode = room.dilatation + i % 4 * room.points + (patch.first_point - c.first_point);
    double seen = 0;
    for (std::int32_t p = 0; p < patch.points; ++p) {
      seen += of_mode[p];
    }
    room.seen[i] = seen;
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
