// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "register/device/tasks.hpp"
#include "solve/device/device_fault.hpp"

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
  if (const cudaError_t error = cudaGetLastError(); error != cudaSuccess) {
    throw solve::device::DeviceFault(std::string("the GPU failed while it was to begin a part of register: ") +
                                     cudaGetErrorString(error) + "; register with device cpu");
  }
}

}  // namespace brainshift::registration::device
