// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cuda_runtime.h>

#include <string>

#include "solve/device/device_fault.hpp"

namespace brainshift::solve::device {

/// Throws DeviceFault where a call of CUDA's has failed; what: the GPU was to do.
inline void check(cudaError_t error, const char* what) {
  cudaGetLastError();  // whoever comes next is not to blame
  if (error == cudaErrorMemoryAllocation) {
    throw DeviceFault("the GPU has not enough free memory; free some, or take device cpu");
  }
  if (error != cudaSuccess) {
    throw DeviceFault(std::string("the GPU failed while it was to ") + what + ": " + cudaGetErrorString(error) +
                      "; take device cpu");
  }
}

}  // namespace brainshift::solve::device
