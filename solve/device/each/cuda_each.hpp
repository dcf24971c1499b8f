// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/each/view.hpp"

namespace brainshift::solve::device {

/// Does an order on the GPU that gpu() is. Throws DeviceFault.
void perform_each_on_gpu(TaskOfEach task, const ViewOfEach<float>& view, const OrderOfEach& order);
void perform_each_on_gpu(TaskOfEach task, const ViewOfEach<double>& view, const OrderOfEach& order);

}  // namespace brainshift::solve::device
