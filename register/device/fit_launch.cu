// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/device/fit_kernels.hpp"
#include "register/device/launch.cuh"

namespace brainshift::registration::device {

void fit_on_gpu(Task task, const View& view, std::size_t items) {
  return task == Task::evaluate ? launch<Task::evaluate>(view, items) : launch<Task::grow>(view, items);
}

}  // namespace brainshift::registration::device
