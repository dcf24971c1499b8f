// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace brainshift::solve::device {

struct Backend;

/// The GPU of this machine, CUDA's first, or nullptr.
const Backend* gpu();

/// Why there is none, as a sentence; empty: there is one.
std::string why_no_gpu();

}  // namespace brainshift::solve::device
