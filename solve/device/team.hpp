// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "segmentation/geometry/on_device.hpp"

namespace brainshift::solve::device {

// The threads that do an order together. They fall into blocks, one a multiprocessor, and each block into groups of
// `lanes`, which share a point or a slot, of `half` and of `wide`, which share a row of a matrix. What is written here
// for any team, one thread does on the host, in the tests, too. A lane waits for `at_once` loads together.

/// The team of one.
struct OneThread {
  static constexpr int lanes = 1, half = 1, wide = 1;
  template <class Scalar>
  static constexpr int at_once = 1;
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
  /// Adds to what threads of the block have in common: whole numbers, so that their order does not matter.
  template <class Whole>
  void add(Whole* to, Whole more) const {
    using Bits = std::make_unsigned_t<Whole>;  // which may run over
    *to = static_cast<Whole>(static_cast<Bits>(*to) + static_cast<Bits>(more));
  }
  void raise(std::uint64_t* to, std::uint64_t key) const { *to = std::max(*to, key); }
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

/// The same of the groups of `wide`, or of another width.
template <class Team, int width = Team::wide>
BRAINSHIFT_ON_DEVICE int first_group(const Team& team) {
  return first_of_all(team) / width;
}
template <class Team, int width = Team::wide>
BRAINSHIFT_ON_DEVICE int all_groups(const Team& team) {
  return all_threads(team) / width;
}

/// The larger; NaN where one is.
BRAINSHIFT_ON_DEVICE inline double larger(double a, double b) {
  return a != a || b <= a ? a : b;
}

/// A whole number that rises with x, above 0, and is largest where x is NaN.
BRAINSHIFT_ON_DEVICE inline std::uint64_t rising_key(double x) {
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  if (x != x) {
    return ~std::uint64_t{0};
  }
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof x);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}
BRAINSHIFT_ON_DEVICE inline double of_rising_key(std::uint64_t key) {
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  const std::uint64_t bits = (key & sign) != 0 ? key & ~sign : ~key;
  double x = 0;
  std::memcpy(&x, &bits, sizeof x);
  return x;
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
