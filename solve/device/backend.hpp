// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "solve/device/gpu.hpp"
#include "solve/device/tasks.hpp"

namespace brainshift::solve::device {

/// Where orders are done: its memory and its team. All that fails throws DeviceFault.
struct Backend {
  int blocks;        ///< of the team
  std::size_t room;  ///< bytes that a block has, at most
  void* (*allocate)(std::size_t bytes);
  void (*release)(void* memory);
  void (*clear)(void* memory, std::size_t bytes);
  void (*to_device)(void* to, const void* from, std::size_t bytes);
  void (*from_device)(void* to, const void* from, std::size_t bytes);
  void (*copy)(void* to, const void* from, std::size_t bytes);  ///< on the device
  void (*single)(Task task, const View<float>& view, const Order& order);
  void (*twofold)(Task task, const View<double>& view, const Order& order);  ///< in double precision

  void perform(Task task, const View<float>& view, const Order& order) const { single(task, view, order); }
  void perform(Task task, const View<double>& view, const Order& order) const { twofold(task, view, order); }
};

/// One thread of the host: for tests, and for whoever looks for a fault.
const Backend& one_thread();

}  // namespace brainshift::solve::device
