// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/backend.hpp"

namespace brainshift::solve::device {

const Backend* gpu() {
  return nullptr;
}

std::string why_no_gpu() {
  return "this program was built without CUDA (BRAINSHIFT_CUDA)";
}

}  // namespace brainshift::solve::device
