// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/device/backend.hpp"
#include "register/device/fit_kernels.hpp"
#include "register/device/launch.cuh"

namespace brainshift::registration::device {

void perform_on_gpu(Task task, const View& view, std::size_t items) {
  if (task == Task::evaluate || task == Task::grow) {
    return fit_on_gpu(task, view, items);
  }
  with_task(task, [&]<Task which>() {
    if constexpr (which != Task::evaluate && which != Task::grow) {
      launch<which>(view, items);
    }
  });
}

const Backend* gpu() {
  if (solve::device::gpu() == nullptr) {
    return nullptr;
  }
  static const Backend backend{*solve::device::gpu(), perform_on_gpu};
  return &backend;
}

}  // namespace brainshift::registration::device
