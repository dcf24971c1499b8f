// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/each/view.hpp"
#include "solve/device/team.hpp"

namespace brainshift::solve::device {

// The threads that step many members together. They fall into blocks, one a multiprocessor, and each block into groups
// whose threads share a point, a slot, a node or a row; each of a group has some members of its own there, on a GPU
// one. So members need no sums across threads, and all of a group take the same way but for who is left out.

/// The team of one thread, which has all members.
struct OneForEach {
  static constexpr int own = most_members;

  int group() const { return 0; }  ///< in the block
  int groups() const { return 1; }
  int block() const { return 0; }
  int blocks() const { return 1; }
  bool leads() const { return true; }  ///< of the group
  void sync_all() const {}

  /// Calls for each of these members that is the thread's own.
  template <class Use>
  void for_each(Members who, const Use& use) const {
    for (int m = 0; m < most_members; ++m) {
      if ((who >> m & 1) != 0) {
        use(m);
      }
    }
  }
  /// Those of these members for which it is so; the whole group knows.
  template <class Use>
  Members which(Members who, const Use& use) const {
    Members those = 0;
    for_each(who, [&](int m) { those |= Members{use(m) ? 1U : 0U} << m; });
    return those;
  }
  /// Numbers of the groups of a block put together, sums, then the largest: use(k, member, number). By all of a block.
  template <int sums, int count, class Use>
  void combine(const double (&of)[count][own], const Use& use) const {
    for (int k = 0; k < count; ++k) {
      for (int m = 0; m < most_members; ++m) {
        use(k, m, of[k][m]);
      }
    }
  }
};

/// Numbers that a thread gathers of its own members.
template <class Team, int count>
struct Gathered {
  double of[count][Team::own] = {};

  BRAINSHIFT_ON_DEVICE double& at(int k, int member) { return of[k][member % Team::own]; }
};

/// The first of these that a group takes, of all that the team shares; the next is all_of_each() further.
template <class Team>
BRAINSHIFT_ON_DEVICE int first_of_each(const Team& team) {
  return team.block() * team.groups() + team.group();
}
template <class Team>
BRAINSHIFT_ON_DEVICE int all_of_each(const Team& team) {
  return team.blocks() * team.groups();
}

/// Leaves a block's numbers where collect_each() finds them.
template <int sums, class Team, int count>
BRAINSHIFT_ON_DEVICE void leave_each(const Team& team, const Gathered<Team, count>& gathered, double* partial) {
  double* to = partial + at_member(static_cast<std::int64_t>(team.block()) * count, 0);
  team.template combine<sums>(gathered.of, [&](int k, int m, double x) { to[at_member(k, m)] = x; });
}

/// What the blocks have left, put together in one order by a block: use(k, member, number). After a sync_all().
template <int sums, int count, class Team, class Use>
BRAINSHIFT_ON_DEVICE void collect_each(const Team& team, Members who, const double* partial, const Use& use) {
  Gathered<Team, count> all;
  team.for_each(who, [&](int m) {
    for (int k = 0; k < count; ++k) {
      all.at(k, m) = k < sums ? 0 : -std::numeric_limits<double>::infinity();
    }
    BRAINSHIFT_AHEAD
    for (int b = team.group(); b < team.blocks(); b += team.groups()) {
      const double* from = partial + at_member(static_cast<std::int64_t>(b) * count, m);
      for (int k = 0; k < count; ++k) {
        const double x = from[at_member(k, 0)];
        all.at(k, m) = k < sums ? all.at(k, m) + x : larger(all.at(k, m), x);
      }
    }
  });
  team.template combine<sums>(all.of, use);
}

}  // namespace brainshift::solve::device
