// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "register/device/tasks.hpp"
#include "solve/device/cuda_check.hpp"

namespace brainshift::registration::device {

inline constexpr int threads = 128;  // of a block: one of Tiles' boxes

template <Task task>
__global__ void __launch_bounds__(threads) kernel(const __grid_constant__ View view, std::size_t items) {
  const std::size_t item = std::size_t{blockIdx.x} * threads + threadIdx.x;
  if (item < items) {
    perform<task>(view, item);
  }
}

/// A thread an item.
template <Task task>
void launch(const View& view, std::size_t items) {
  if (items == 0) {
    return;
  }
  kernel<task><<<static_cast<unsigned>((items + threads - 1) / threads), threads>>>(view, items);
  solve::device::check(cudaGetLastError(), "begin a part of register");
}

}  // namespace brainshift::registration::device
