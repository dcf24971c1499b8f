// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/arrays/shared_work.hpp"

#include <omp.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <map>

namespace brainshift::solve {

namespace {

/// One for each number of threads, since an arena keeps its size; of each calling thread, since callers may be several.
tbb::task_arena& arena(int threads) {
  thread_local std::map<int, tbb::task_arena> arenas;
  return arenas.try_emplace(threads, threads).first->second;
}

}  // namespace

void share_parts(std::int64_t count, std::int64_t part_length, PartOfWork part, const void* body) {
  const int threads = omp_get_max_threads();
  if (count <= part_length || threads == 1 || omp_in_parallel() != 0) {
    part(body, 0, count, 0);
    return;
  }
  using Range = tbb::blocked_range<std::int64_t>;
  const auto run = [=](const Range& range) {
    part(body, range.begin(), range.end(), tbb::this_task_arena::current_thread_index());
  };
  arena(threads).execute([&] {
    tbb::parallel_for(Range(0, count, static_cast<std::size_t>(part_length)), run, tbb::simple_partitioner());
  });
}

}  // namespace brainshift::solve
