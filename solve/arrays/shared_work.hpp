// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>

namespace brainshift::solve {

/// Part of a loop: calls the loop's body for [first, last). worker: 0 to omp_get_max_threads() - 1, no two of them at
/// the same time.
using PartOfWork = void (*)(const void* body, std::int64_t first, std::int64_t last, int worker);

void share_parts(std::int64_t count, std::int64_t part_length, PartOfWork part, const void* body);

/// Calls body(i) or body(i, worker) for i in [0, count) on omp_get_max_threads() threads, in parts of at most
/// part_length; on one thread, or within a parallel region, the caller does all. Whichever thread is awake takes the
/// next part: a thread that another program keeps waiting holds up nothing but the part that it has in hand. For the
/// loops of a step, none of which may be OpenMP's: threads of both would take processors from each other.
template <class Body>
void share_work(std::int64_t count, std::int64_t part_length, const Body& body) {
  share_parts(
      count, part_length,
      [](const void* erased, std::int64_t first, std::int64_t last, int worker) {
        const Body& of_index = *static_cast<const Body*>(erased);
        for (std::int64_t i = first; i < last; ++i) {
          if constexpr (std::invocable<const Body&, std::int64_t, int>) {
            of_index(i, worker);
          } else {
            of_index(i);
          }
        }
      },
      &body);
}

/// Lengths of parts that take much longer than to hand them out: nodes that are moved or summed, and places that are
/// looked up.
constexpr std::int64_t nodes_a_part = 512, places_a_part = 64;

}  // namespace brainshift::solve
