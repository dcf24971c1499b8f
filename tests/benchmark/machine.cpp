// SPDX-License-Identifier: GPL-3.0-or-later
//
// What this machine can do, for the other tables to be held against: bytes a second that a loop reads, from memory and
// from the caches, and fused multiply-adds, for 1 to as many threads as there are. Compiled for this processor.
//
//   machine OUT.csv [SECONDS]     (for each figure, 1 if absent)
#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "segmentation/progress/stopwatch.hpp"

namespace {

// A register of this processor: GCC takes longer vectors apart, by way of memory.
#if defined(__AVX512F__)
constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
constexpr std::size_t register_bytes = 32;
#else
constexpr std::size_t register_bytes = 16;
#endif
template <class T>
using Vector [[gnu::vector_size(register_bytes)]] = T;
using Floats [[gnu::vector_size(register_bytes), gnu::aligned(4)]] = float;
constexpr std::size_t floats = register_bytes / sizeof(float);

/// Kept, so that no loop is left out.
thread_local volatile double sink;

/// Sums with eight running sums, so that loads are what it waits for.
float sum(const float* from, std::size_t count) {
  Floats part[8] = {};
  for (std::size_t i = 0; i + 8 * floats <= count; i += 8 * floats) {
    for (std::size_t k = 0; k < 8; ++k) {
      part[k] += *reinterpret_cast<const Floats*>(from + i + floats * k);
    }
  }
  float total = 0;
  for (const Floats& p : part) {
    for (std::size_t lane = 0; lane < floats; ++lane) {
      total += p[lane];
    }
  }
  return total;
}

/// Calls work(thread) on all threads again and again; the best rate of `amount` a thread and call, in 1e9 a second.
template <class Work>
double best_rate(int threads, double seconds, double amount, const Work& work) {
  double best = 0;
  for (const brainshift::Stopwatch all; all.seconds() < seconds;) {
    const brainshift::Stopwatch watch;
#pragma omp parallel num_threads(threads)
    work(omp_get_thread_num());
    best = std::max(best, threads * amount / watch.seconds());
  }
  return 1e-9 * best;
}

/// GB/s read from `bytes` in all, each thread from its own share, which it wrote itself.
double read_rate(int threads, double seconds, std::size_t bytes) {
  const std::size_t each = bytes / sizeof(float) / static_cast<std::size_t>(threads) / 128 * 128;
  std::vector<float*> share(static_cast<std::size_t>(threads));
#pragma omp parallel num_threads(threads)
  {
    auto* memory = static_cast<float*>(std::aligned_alloc(64, each * sizeof(float)));
    std::fill(memory, memory + each, 1.F);
    share[static_cast<std::size_t>(omp_get_thread_num())] = memory;
  }
  const std::size_t passes =
      std::max<std::size_t>(1, (std::size_t{256} << 20) / bytes);  // else the threads' start counts
  const double amount = static_cast<double>(passes * each * sizeof(float));
  const double rate = best_rate(threads, seconds, amount, [&](int thread) {
    for (std::size_t pass = 0; pass < passes; ++pass) {
      sink = sum(share[static_cast<std::size_t>(thread)], each);
    }
  });
  for (float* memory : share) {
    std::free(memory);
  }
  return rate;
}

/// GFLOP/s of multiply-adds, twelve chains side by side.
template <class T>
double flop_rate(int threads, double seconds) {
  constexpr int chains = 12, rounds = 4000000;
  constexpr double lanes = register_bytes / sizeof(T);
  return best_rate(threads, seconds, 2.0 * chains * rounds * lanes, [](int) {
    Vector<T> x[chains];
    for (int k = 0; k < chains; ++k) {
      x[k] = Vector<T>{} + static_cast<T>(k);
    }
    const Vector<T> a = Vector<T>{} + static_cast<T>(0.999), b = Vector<T>{} + static_cast<T>(sink * 0 + 0.001);
    for (int i = 0; i < rounds; ++i) {
#pragma GCC unroll 12
      for (int k = 0; k < chains; ++k) {
        x[k] = x[k] * a + b;
      }
    }
    for (int k = 1; k < chains; ++k) {
      x[0] += x[k];
    }
    sink = static_cast<double>(x[0][0]);
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: machine OUT.csv [SECONDS]\n");
    return 2;
  }
  const double seconds = argc > 2 ? std::atof(argv[2]) : 1;
  const std::size_t memory = seconds < 0.5 ? std::size_t{256} << 20 : std::size_t{3} << 30;  // beyond any cache
  std::ofstream csv(argv[1]);
  csv << "figure,unit,threads,value\n";
  const auto write = [&](const std::string& figure, const char* unit, int threads, double value) {
    csv << '"' << figure << "\"," << unit << ',' << threads << ',' << value << '\n';
    std::printf("%-32s %d threads %8.1f %s\n", figure.c_str(), threads, value, unit);
  };
  for (int threads = 1; threads <= omp_get_max_threads(); threads *= 2) {
    write("read from memory", "GB/s", threads, read_rate(threads, seconds, memory));
    write("read, 32 MB", "GB/s", threads, read_rate(threads, seconds, std::size_t{32} << 20));
    write("read, 16 MB", "GB/s", threads, read_rate(threads, seconds, std::size_t{16} << 20));
    write("read, 1 MB a thread", "GB/s", threads, read_rate(threads, seconds, static_cast<std::size_t>(threads) << 20));
    write("multiply-add, double", "GFLOP/s", threads, flop_rate<double>(threads, seconds));
    write("multiply-add, float", "GFLOP/s", threads, flop_rate<float>(threads, seconds));
  }
  return csv.flush() ? 0 : 1;
}
