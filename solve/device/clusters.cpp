// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/clusters.hpp"

#include <algorithm>
#include <numeric>

#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve::device {

namespace {

/// Turns counts, one further on, into offsets.
void add_up(std::vector<std::int64_t>& begin) {
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
}

/// Patches one after the other, with so many pairs at most: the cluster of each.
std::vector<std::int32_t> cut_at(const std::vector<std::int64_t>& pairs, std::int64_t most) {
  std::vector<std::int32_t> cluster;
  std::int64_t in_cluster = 0;
  for (const std::int64_t of_patch : pairs) {
    const bool full = !cluster.empty() && in_cluster + of_patch > most;
    in_cluster = full ? of_patch : in_cluster + of_patch;
    cluster.push_back(cluster.empty() ? 0 : cluster.back() + (full ? 1 : 0));
  }
  return cluster;
}

/// The cluster of each patch, so that the one with the most pairs has as few as can be: it takes the longest.
std::vector<std::int32_t> divide(const PointBlocks& points, std::int32_t count) {
  std::vector<std::int64_t> pairs;
  for (const Patch& patch : points.patches) {
    std::int64_t of_patch = 0;
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      of_patch += points.support[static_cast<std::size_t>(p)];
    }
    pairs.push_back(of_patch);
  }
  std::int64_t too_few = 0, enough = std::accumulate(pairs.begin(), pairs.end(), std::int64_t{0});
  while (enough - too_few > 1) {
    const std::int64_t middle = (too_few + enough) / 2;
    (cut_at(pairs, middle).back() < count ? enough : too_few) = middle;
  }
  return cut_at(pairs, enough);
}

/// The block of each patch.
std::vector<const Block*> blocks_of_patches(const PointBlocks& points) {
  std::vector<const Block*> block;
  for (const Block& b : points.blocks) {
    block.insert(block.end(), static_cast<std::size_t>(b.last_patch - b.first_patch), &b);
  }
  return block;
}

/// A cluster by itself: offsets count from its own first.
template <class Scalar>
struct Part {
  std::size_t first_patch, last_patch;
  std::vector<std::int32_t> nodes = {};  ///< of its slots
  std::vector<std::int64_t> pair_end = {}, slot_end = {}, touch_end = {};
  std::vector<Pair<Scalar>> pairs = {}, slot_pairs = {};
  std::vector<Touch> touches = {};
};

template <class Scalar>
class PartMaker {
 public:
  PartMaker(const PointBlocks& points, const std::vector<const Block*>& block_of, Part<Scalar>& part)
      : points_(points), block_of_(block_of), part_(part) {
    list_nodes();
    list_pairs();
    list_slots();
  }

 private:
  /// Calls for each point and each node of its support.
  template <class Each>
  void for_pairs(const Each& each) const {
    for (std::size_t k = part_.first_patch; k < part_.last_patch; ++k) {
      for (std::int32_t p = points_.patches[k].first_point; p < points_.patches[k].last_point; ++p) {
        const Scalar* derivative = points_.derivatives_of<Scalar>(p);
        for (const std::uint16_t slot : points_.slots_of(p)) {
          each(p, points_.node_of(*block_of_[k], slot), derivative);
          derivative += 3;
        }
      }
    }
  }

  std::int32_t first_point() const { return points_.patches[part_.first_patch].first_point; }

  /// Nodes ascend, so that those of a cluster are found by halving.
  void list_nodes() {
    for_pairs([&](std::int32_t, std::int32_t node, const Scalar*) { part_.nodes.push_back(node); });
    std::sort(part_.nodes.begin(), part_.nodes.end());
    part_.nodes.erase(std::unique(part_.nodes.begin(), part_.nodes.end()), part_.nodes.end());
  }

  void list_pairs() {
    part_.pair_end.resize(static_cast<std::size_t>(points_.patches[part_.last_patch - 1].last_point - first_point()));
    for_pairs([&](std::int32_t p, std::int32_t node, const Scalar* b) {
      const auto slot = std::lower_bound(part_.nodes.begin(), part_.nodes.end(), node) - part_.nodes.begin();
      part_.pairs.push_back({{b[0], b[1], b[2]}, static_cast<std::int32_t>(slot)});
      part_.pair_end[static_cast<std::size_t>(p - first_point())] = std::ssize(part_.pairs);
    });
  }

  /// The pairs once more, by slot and in the order of the points, and where patches touch slots.
  void list_slots() {
    std::vector<std::int64_t> begin(part_.nodes.size() + 1, 0);
    for (const Pair<Scalar>& pair : part_.pairs) {
      ++begin[static_cast<std::size_t>(pair.other) + 1];
    }
    add_up(begin);
    part_.slot_end.assign(begin.begin() + 1, begin.end());
    part_.slot_pairs.resize(part_.pairs.size());
    std::vector<std::int32_t> patch_of;
    for (std::size_t k = part_.first_patch; k < part_.last_patch; ++k) {
      const Patch& patch = points_.patches[k];
      patch_of.insert(patch_of.end(), static_cast<std::size_t>(patch.last_point - patch.first_point),
                      static_cast<std::int32_t>(k));
    }
    std::int32_t point = 0;
    for (std::size_t k = 0; k < part_.pairs.size(); ++k) {
      while (part_.pair_end[static_cast<std::size_t>(point)] <= static_cast<std::int64_t>(k)) {
        ++point;
      }
      Pair<Scalar> pair = part_.pairs[k];
      std::int64_t& to = begin[static_cast<std::size_t>(pair.other)];
      pair.other = point;
      part_.slot_pairs[static_cast<std::size_t>(to++)] = pair;
    }
    for (std::size_t s = 0; s < part_.nodes.size(); ++s) {
      list_touches(s == 0 ? 0 : part_.slot_end[s - 1], part_.slot_end[s], patch_of);
    }
  }

  void list_touches(std::int64_t first, std::int64_t last, const std::vector<std::int32_t>& patch_of) {
    const auto patch_at = [&](std::int64_t i) {
      return patch_of[static_cast<std::size_t>(part_.slot_pairs[static_cast<std::size_t>(i)].other)];
    };
    for (std::int64_t k = first, next = first; k < last; k = next) {
      while (next < last && patch_at(next) == patch_at(k)) {
        ++next;
      }
      part_.touches.push_back({k, static_cast<std::int32_t>(next - k), patch_at(k)});
    }
    part_.touch_end.push_back(std::ssize(part_.touches));
  }

  const PointBlocks& points_;
  const std::vector<const Block*>& block_of_;
  Part<Scalar>& part_;
};

template <class Number>
void append(const std::vector<Number>& more, std::vector<Number>& to) {
  to.insert(to.end(), more.begin(), more.end());
}

void append(const std::vector<std::int64_t>& ends, std::int64_t before, std::vector<std::int64_t>& to) {
  for (const std::int64_t end : ends) {
    to.push_back(before + end);
  }
}

template <class Scalar>
void append(Part<Scalar>& part, const PointBlocks& points, Clusters<Scalar>& to) {
  const std::int32_t first_point = points.patches[part.first_patch].first_point;
  const auto count = static_cast<std::int32_t>(part.pair_end.size());
  const std::int64_t pairs = std::ssize(to.pairs), touches = std::ssize(to.touches);
  to.clusters.push_back({first_point, count, static_cast<std::int32_t>(part.first_patch),
                         static_cast<std::int32_t>(part.last_patch - part.first_patch),
                         static_cast<std::int32_t>(part.nodes.size()), std::ssize(to.slot_node)});
  for (std::size_t k = part.first_patch; k < part.last_patch; ++k) {
    const Patch& patch = points.patches[k];
    to.patches.push_back({patch.first_point, patch.last_point - patch.first_point, patch.material});
    to.patch_of.insert(to.patch_of.end(), static_cast<std::size_t>(patch.last_point - patch.first_point),
                       static_cast<std::int32_t>(k));
  }
  append(part.nodes, to.slot_node);
  append(part.pair_end, pairs, to.pair_begin);
  append(part.slot_end, pairs, to.slot_begin);
  append(part.touch_end, touches, to.touch_begin);
  append(part.pairs, to.pairs);
  append(part.slot_pairs, to.slot_pairs);
  for (Touch touch : part.touches) {
    touch.first += pairs;
    to.touches.push_back(touch);
  }
  to.most_slots = std::max(to.most_slots, static_cast<std::int32_t>(part.nodes.size()));
  to.most_points = std::max(to.most_points, count);
  part = {};
}

template <class Scalar>
void list_nodes(std::size_t nodes, Clusters<Scalar>& to) {
  to.node_begin.assign(nodes + 1, 0);
  for (const std::int32_t node : to.slot_node) {
    ++to.node_begin[static_cast<std::size_t>(node) + 1];
  }
  add_up(to.node_begin);
  std::vector<std::int64_t> next(to.node_begin.begin(), to.node_begin.end() - 1);
  to.node_slot.resize(to.slot_node.size());
  for (std::size_t s = 0; s < to.slot_node.size(); ++s) {
    std::int64_t& at = next[static_cast<std::size_t>(to.slot_node[s])];
    to.node_slot[static_cast<std::size_t>(at++)] = static_cast<std::int32_t>(s);
  }
}

template <class Scalar>
void list_touches_of_patches(Clusters<Scalar>& to) {
  to.patch_touch_begin.assign(to.patches.size() + 1, 0);
  for (const Touch& touch : to.touches) {
    ++to.patch_touch_begin[static_cast<std::size_t>(touch.patch) + 1];
  }
  add_up(to.patch_touch_begin);
  std::vector<std::int64_t> next(to.patch_touch_begin.begin(), to.patch_touch_begin.end() - 1);
  to.patch_touch.resize(to.touches.size());
  to.patch_touch_node.resize(to.touches.size());
  for (std::size_t s = 0; s < to.slot_node.size(); ++s) {
    for (std::int64_t k = to.touch_begin[s]; k < to.touch_begin[s + 1]; ++k) {
      std::int64_t& at = next[static_cast<std::size_t>(to.touches[static_cast<std::size_t>(k)].patch)];
      to.patch_touch[static_cast<std::size_t>(at)] = k;
      to.patch_touch_node[static_cast<std::size_t>(at++)] = to.slot_node[s];
    }
  }
}

}  // namespace

template <class Scalar>
Clusters<Scalar> make_clusters(const PointBlocks& points, std::int32_t count) {
  const std::vector<std::int32_t> cluster = divide(points, count);
  std::vector<Part<Scalar>> parts;
  for (std::size_t first = 0, last = 0; first < cluster.size(); first = last) {
    while (last < cluster.size() && cluster[last] == cluster[first]) {
      ++last;
    }
    parts.push_back({.first_patch = first, .last_patch = last});
  }
  const std::vector<const Block*> block_of = blocks_of_patches(points);
  share_work(std::ssize(parts), 1,
             [&](std::int64_t i) { PartMaker<Scalar>(points, block_of, parts[static_cast<std::size_t>(i)]); });
  Clusters<Scalar> made;
  made.pair_begin = made.slot_begin = made.touch_begin = {0};
  made.pairs.reserve(points.pair_slot.size());
  made.slot_pairs.reserve(points.pair_slot.size());
  for (Part<Scalar>& part : parts) {
    append(part, points, made);
  }
  list_nodes(points.nodes(), made);
  list_touches_of_patches(made);
  return made;
}
template Clusters<float> make_clusters(const PointBlocks&, std::int32_t);
template Clusters<double> make_clusters(const PointBlocks&, std::int32_t);

NodeRows by_node(const CompressedRows& from) {
  const auto& [begin, node, shape] = from;
  NodeRows rows;
  rows.node = node;
  std::sort(rows.node.begin(), rows.node.end());
  rows.node.erase(std::unique(rows.node.begin(), rows.node.end()), rows.node.end());
  const auto place = [&](std::int32_t of) {
    return static_cast<std::size_t>(std::lower_bound(rows.node.begin(), rows.node.end(), of) - rows.node.begin());
  };
  rows.begin.assign(rows.node.size() + 1, 0);
  for (const std::int32_t of : node) {
    ++rows.begin[place(of) + 1];
  }
  add_up(rows.begin);
  std::vector<std::int64_t> next(rows.begin.begin(), rows.begin.end() - 1);
  rows.row.resize(node.size());
  rows.shape.resize(node.size());
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
    for (std::int64_t k = begin[i]; k < begin[i + 1]; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const auto to = static_cast<std::size_t>(next[place(node[at])]++);
      rows.row[to] = static_cast<std::int32_t>(i);
      rows.shape[to] = shape[at];
    }
  }
  return rows;
}

}  // namespace brainshift::solve::device
