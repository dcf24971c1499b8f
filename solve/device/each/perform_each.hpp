// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/backend.hpp"
#include "solve/device/each/view.hpp"

namespace brainshift::solve::device {

/// Does an order of many loads, on one_thread() or on gpu(). Throws DeviceFault.
void perform_each(const Backend& backend, TaskOfEach task, const ViewOfEach<float>& view, const OrderOfEach& order);
void perform_each(const Backend& backend, TaskOfEach task, const ViewOfEach<double>& view, const OrderOfEach& order);

}  // namespace brainshift::solve::device
