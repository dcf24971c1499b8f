// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace brainshift::solve::device {

/// The device has not enough memory, or is gone: what() is a sentence about it.
struct DeviceFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace brainshift::solve::device
