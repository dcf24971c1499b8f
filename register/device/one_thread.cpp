// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/device/backend.hpp"

namespace brainshift::registration::device {

namespace {

void perform_alone(Task task, const View& view, std::size_t count) {
  with_task(task, [&]<Task which>() {
    for (std::size_t item = 0; item < count; ++item) {
      perform<which>(view, item);
    }
  });
}

}  // namespace

const Backend& one_thread() {
  static const Backend backend{solve::device::one_thread(), perform_alone};
  return backend;
}

}  // namespace brainshift::registration::device
