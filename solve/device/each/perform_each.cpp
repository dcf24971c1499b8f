// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/each/perform_each.hpp"

#include "solve/device/each/cuda_each.hpp"
#include "solve/device/each/tasks.hpp"

namespace brainshift::solve::device {

namespace {

template <class Scalar>
void perform_there(const Backend& backend, TaskOfEach task, const ViewOfEach<Scalar>& view, const OrderOfEach& order) {
  if (&backend == &one_thread()) {
    with_task(task, [&]<TaskOfEach which>() { perform<which>(OneForEach{}, view, order); });
  } else {
    perform_each_on_gpu(task, view, order);
  }
}

}  // namespace

void perform_each(const Backend& backend, TaskOfEach task, const ViewOfEach<float>& view, const OrderOfEach& order) {
  perform_there(backend, task, view, order);
}
void perform_each(const Backend& backend, TaskOfEach task, const ViewOfEach<double>& view, const OrderOfEach& order) {
  perform_there(backend, task, view, order);
}

}  // namespace brainshift::solve::device
