// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "register/device/tasks.hpp"
#include "solve/device/backend.hpp"

namespace brainshift::registration::device {

/// Where tasks are done: its memory, the solver's, and how. All that fails throws solve::device::DeviceFault.
struct Backend {
  const solve::device::Backend& memory;
  void (*perform)(Task task, const View& view, std::size_t items);
};

/// One thread of the host: for tests, and for whoever looks for a fault.
const Backend& one_thread();

/// The GPU of this machine, or nullptr: solve::device::why_no_gpu() says why in a sentence.
const Backend* gpu();

}  // namespace brainshift::registration::device
