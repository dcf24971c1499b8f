// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstring>
#include <new>

#include "solve/device/backend.hpp"

namespace brainshift::solve::device {

namespace {

/// Aligned as what a block keeps.
struct alignas(64) Line {
  std::byte bytes[64];
};

template <class Scalar>
void perform_alone(Task task, const View<Scalar>& view, const Order& order) {
  std::vector<Line> memory(std::max(Room<Scalar>::size(view), room_to_sweep) / sizeof(Line) + 1);
  const OneThread alone{memory.front().bytes};
  with_task(task, [&]<Task which>() { perform<which>(alone, view, order); });
}

void copy(void* to, const void* from, std::size_t bytes) {
  if (bytes > 0) {
    std::memcpy(to, from, bytes);
  }
}

}  // namespace

const Backend& one_thread() {
  static const Backend backend{
      .blocks = 5,  // as if: a body falls into several clusters, which the one thread handles in turn
      .room = std::size_t{64} << 10,
      .allocate = [](std::size_t bytes) { return ::operator new(bytes, std::align_val_t(64)); },
      .release = [](void* memory) { ::operator delete(memory, std::align_val_t(64)); },
      .clear = [](void* memory, std::size_t bytes) { std::memset(memory, 0, bytes); },
      .to_device = copy,
      .from_device = copy,
      .copy = copy,
      .single = perform_alone<float>,
      .twofold = perform_alone<double>};
  return backend;
}

}  // namespace brainshift::solve::device
