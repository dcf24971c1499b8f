// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/device/backend.hpp"

namespace brainshift::registration::device {

const Backend* gpu() {
  return nullptr;
}

}  // namespace brainshift::registration::device
