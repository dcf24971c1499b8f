// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/each/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift::solve::device {

namespace {

constexpr std::int32_t most_points_of_piece = 8;

/// Numbers of the body in the place of those of the clusters.
template <class Scalar>
void count_over_body(Clusters<Scalar>& of) {
  const auto all = [](auto& pairs, std::int64_t first, std::int64_t end, const auto& number) {
    for (std::int64_t k = first; k < end; ++k) {
      std::int32_t& other = pairs[static_cast<std::size_t>(k)].other;
      other = number(other);
    }
  };
  for (const Cluster& c : of.clusters) {
    const auto point = static_cast<std::size_t>(c.first_point), slot = static_cast<std::size_t>(c.first_slot);
    all(of.pairs, of.pair_begin[point], of.pair_begin[point + static_cast<std::size_t>(c.points)],
        [&](std::int32_t other) { return of.slot_node[slot + static_cast<std::size_t>(other)]; });
    all(of.slot_pairs, of.slot_begin[slot], of.slot_begin[slot + static_cast<std::size_t>(c.slots)],
        [&](std::int32_t other) { return c.first_point + other; });
  }
}

std::int32_t pieces_of(std::int32_t points, std::int32_t longest) {
  return (points + longest - 1) / longest;
}

template <class Scalar>
std::int32_t points_of_piece(const Clusters<Scalar>& of, std::int32_t most_pieces) {
  std::int32_t longest = 1;
  for (; longest < most_points_of_piece; ++longest) {
    std::int64_t pieces = 0;
    for (const PatchPoints& patch : of.patches) {
      pieces += pieces_of(patch.points, longest);
    }
    if (pieces <= most_pieces) {
      break;
    }
  }
  return longest;
}

/// Pieces of a patch are about as long as each other.
template <class Scalar>
void cut(std::int32_t longest, Pieces<Scalar>& made) {
  for (const PatchPoints& patch : made.of.patches) {
    const std::int32_t count = pieces_of(patch.points, longest);
    const auto number = static_cast<std::int32_t>(made.patches.size());
    made.patches.push_back({static_cast<std::int32_t>(made.pieces.size()), count, patch.material});
    for (std::int32_t i = 0; i < count; ++i) {
      const auto begin_of = [&](std::int64_t piece) { return static_cast<std::int32_t>(patch.points * piece / count); };
      const std::int32_t first = begin_of(i), end = begin_of(i + 1);
      made.pieces.push_back({patch.first_point + first, end - first, number});
    }
  }
}

template <class Scalar>
void share_slots(std::int64_t shares, Pieces<Scalar>& made) {
  const std::vector<std::int64_t>& begin = made.of.slot_begin;
  for (std::int64_t share = 0; share <= shares; ++share) {
    const auto at = std::lower_bound(begin.begin(), begin.end(), begin.back() * share / shares);
    made.share_begin.push_back(static_cast<std::int32_t>(at - begin.begin()));
  }
  made.share_begin.back() = static_cast<std::int32_t>(made.of.slot_node.size());
}

template <class Scalar>
double reach_of(const Touch& touch, const Clusters<Scalar>& of, const PointBlocks& points) {
  double sum = 0;
  for (std::int64_t k = touch.first; k < touch.first + touch.pairs; ++k) {
    const Pair<Scalar>& pair = of.slot_pairs[static_cast<std::size_t>(k)];
    double square = 0;
    for (const Scalar component : pair.derivative) {
      square += static_cast<double>(component) * static_cast<double>(component);
    }
    sum += points.volume[static_cast<std::size_t>(pair.other)] * std::sqrt(square);
  }
  return sum;
}

}  // namespace

template <class Scalar>
Pieces<Scalar> make_pieces(const PointBlocks& points, int blocks) {
  Pieces<Scalar> made;
  made.of = make_clusters<Scalar>(points, std::min(blocks, static_cast<int>(points.points())));
  count_over_body(made.of);
  cut(points_of_piece(made.of, blocks * groups_of_block), made);
  share_slots(blocks, made);
  for (const Touch& touch : made.of.touches) {
    made.touch_reach.push_back(reach_of(touch, made.of, points));
  }
  return made;
}
template Pieces<float> make_pieces(const PointBlocks&, int);
template Pieces<double> make_pieces(const PointBlocks&, int);

}  // namespace brainshift::solve::device
