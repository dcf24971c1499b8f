// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/arrays/shared_work.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "solve/arrays/nodal_vectors.hpp"

namespace brainshift::solve::shared_work_test {

/// The number of threads while it lives.
class Threads {
 public:
  explicit Threads(int count) { omp_set_num_threads(count); }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  const int before_ = omp_get_max_threads();
};

TEST(SharedWork, DoesEachIndexOnceForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3, 64}) {
    const Threads so_many(threads);
    for (const std::int64_t count : {0, 1, 7, 1000}) {
      std::vector<int> done(static_cast<std::size_t>(count), 0);
      share_work(count, 3, [&](std::int64_t i) { ++done[static_cast<std::size_t>(i)]; });
      EXPECT_EQ(std::ranges::count(done, 1), count) << threads << " threads";
    }
  }
}

TEST(SharedWork, GivesEachWorkerARoomThatNobodyElseIsIn) {
  constexpr int threads = 4;
  const Threads so_many(threads);
  std::vector<std::atomic<int>> inside(threads);
  std::atomic<int> met = 0;
  share_work(2000, 1, [&](std::int64_t, int worker) {
    std::atomic<int>& room = inside[static_cast<std::size_t>(worker)];
    met += room++;
    --room;
  });
  EXPECT_EQ(met, 0);
}

TEST(SharedWork, WithinAParallelRegionIsDoneByTheThreadThatAsks) {
  const Threads so_many(2);
  std::atomic<int> done = 0, elsewhere = 0;
#pragma omp parallel num_threads(2)
  {
    const int asked = omp_get_thread_num();
    share_work(100, 1, [&](std::int64_t, int worker) {
      ++done;
      elsewhere += worker != 0 || omp_get_thread_num() != asked ? 1 : 0;
    });
  }
  EXPECT_EQ(done, 200);
  EXPECT_EQ(elsewhere, 0);
}

TEST(SumOverNodes, IsTheSameToTheLastBitForAnyNumberOfThreads) {
  const auto sum = [](int threads) {
    const Threads so_many(threads);
    return sum_over_nodes(5000, [](std::size_t a) { return 1 / (1.0 + static_cast<double>(a)); });
  };
  const double alone = sum(1);
  EXPECT_EQ(alone, sum(2));
  EXPECT_EQ(alone, sum(5));
}

}  // namespace brainshift::solve::shared_work_test
