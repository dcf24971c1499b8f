// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace brainshift::solve::device {

/// The device has not enough memory, or is gone: what() is a sentence about it.
struct DeviceFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What was to be done on a device alone is nothing for it: what() is a sentence about it.
struct NotOnDevice : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace brainshift::solve::device
