// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/backend.hpp"
#include "solve/device/device_fault.hpp"
#include "solve/device/each/cuda_each.hpp"

namespace brainshift::solve::device {

void perform_each_on_gpu(TaskOfEach, const ViewOfEach<float>&, const OrderOfEach&) {
  throw DeviceFault(why_no_gpu());
}
void perform_each_on_gpu(TaskOfEach, const ViewOfEach<double>&, const OrderOfEach&) {
  throw DeviceFault(why_no_gpu());
}

}  // namespace brainshift::solve::device
