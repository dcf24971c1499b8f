// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "register/device/tasks.hpp"

namespace brainshift::registration::device {

/// Has the GPU begin a task. Each in a file of its own, as the compiler has two ways with a · b + c: rounded once,
/// which is quick, where the processor's own fits do the same; rounded twice, as the processor does it everywhere else,
/// so that what is rounded for good in the end is the same on both.
void fit_on_gpu(Task task, const View& view, std::size_t items);
void perform_on_gpu(Task task, const View& view, std::size_t items);

}  // namespace brainshift::registration::device
