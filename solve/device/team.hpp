// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "segmentation/geometry/on_device.hpp"

namespace brainshift::solve::device {

// The threads that do an order together. They fall into blocks, one a multiprocessor, and each block into groups of
// `lanes`, which share a point or a slot, and of `wide`, which share a row of a dense matrix. What is written here for
// any team, one thread does on the host, in the tests, too. A lane waits for `at_once` loads together.

/// The team of one.
struct OneThread {
  static constexpr int lanes = 1, wide = 1, at_once = 1;
  std::byte* memory;  ///< of the block

  int thread() const { return 0; }  ///< in the block
  int threads() const { return 1; }
  int block() const { return 0; }
  int blocks() const { return 1; }
  std::byte* room() const { return memory; }
  void sync_block() const {}
  void sync_all() const {}

  template <int width>
  double sum(double x) const {
    return x;
  }
  template <int width>
  float sum(float x) const {
    return x;
  }
  template <int width>
  double largest(double x) const {
    return x;
  }
  /// Of the whole block: sums, and the largest of those behind.
  template <int sums, int count>
  void combine(const double (&of_thread)[count], double* of_block) const {
    for (int k = 0; k < count; ++k) {
      of_block[k] = of_thread[k];
    }
  }
};

/// The first of these that a thread takes, of all that the team shares; the next is all_threads() further.
template <class Team>
BRAINSHIFT_ON_DEVICE int first_of_all(const Team& team) {
  return team.block() * team.threads() + team.thread();
}
template <class Team>
BRAINSHIFT_ON_DEVICE int all_threads(const Team& team) {
  return team.blocks() * team.threads();
}

/// The same of the groups of `wide`.
template <class Team>
BRAINSHIFT_ON_DEVICE int first_group(const Team& team) {
  return first_of_all(team) / Team::wide;
}
template <class Team>
BRAINSHIFT_ON_DEVICE int all_groups(const Team& team) {
  return all_threads(team) / Team::wide;
}

/// The larger; NaN where one is.
BRAINSHIFT_ON_DEVICE inline double larger(double a, double b) {
  return a != a || b <= a ? a : b;
}

/// Gives the entries [first, end) of a list to the lanes in turn. What is beyond the end is empty.
template <class Team, class Entry, class Use>
BRAINSHIFT_ON_DEVICE void for_entries(const Team& team, const Entry* list, std::int64_t first, std::int64_t end,
                                      const Use& use) {
  constexpr int lanes = Team::lanes, at_once = Team::at_once;
  for (std::int64_t k = first + team.thread() % lanes; k < end; k += lanes * at_once) {
    Entry batch[at_once];
    BRAINSHIFT_UNROLLED
    for (int i = 0; i < at_once; ++i) {
      batch[i] = k + i * lanes < end ? list[k + i * lanes] : Entry{};
    }
    BRAINSHIFT_UNROLLED
    for (int i = 0; i < at_once; ++i) {
      use(batch[i]);
    }
  }
}

/// Leaves a block's numbers where collect() finds them.
template <int sums, int count, class Team>
BRAINSHIFT_ON_DEVICE void leave(const Team& team, const double (&of_thread)[count], double* partial) {
  team.template combine<sums, count>(of_thread, partial + team.block() * count);
}

/// What the blocks have left of the k-th number, put together in one order, for each of the group of `wide`. After a
/// sync_all().
template <int sums, int count, class Team>
BRAINSHIFT_ON_DEVICE double of_all_blocks(const Team& team, const double* partial, int k) {
  constexpr int wide = Team::wide;
  double all = k < sums ? 0 : -std::numeric_limits<double>::infinity();
  for (int b = team.thread() % wide; b < team.blocks(); b += wide) {
    const double of_block = partial[b * count + k];
    all = k < sums ? all + of_block : larger(all, of_block);
  }
  return k < sums ? team.template sum<wide>(all) : team.template largest<wide>(all);
}

/// All of them, by one block.
template <int sums, int count, class Team>
BRAINSHIFT_ON_DEVICE void collect(const Team& team, const double* partial, double* out) {
  constexpr int wide = Team::wide;
  for (int k = team.thread() / wide; k < count; k += team.threads() / wide) {
    const double all = of_all_blocks<sums, count>(team, partial, k);
    if (team.thread() % wide == 0) {
      out[k] = all;
    }
  }
}

}  // namespace brainshift::solve::device
