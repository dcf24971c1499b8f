// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/kept_on_device.hpp"

#include "solve/device/device_body.hpp"
#include "solve/device/device_fault.hpp"
#include "solve/device/relax_if_asked.hpp"
#include "solve/device/relax_on_device.hpp"

namespace brainshift::solve::device {

namespace {

template <class Scalar>
DeviceBody<Scalar>& under_its_load(std::unique_ptr<DeviceBody<Scalar>>& on, const Backend& backend, const Body& body) {
  if (on) {
    on->load(body);
  } else {
    on = std::make_unique<DeviceBody<Scalar>>(backend, body, settled_window);
  }
  return *on;
}

}  // namespace

KeptOnDevice::KeptOnDevice(const Backend* backend) : backend_(backend) {}

KeptOnDevice::~KeptOnDevice() = default;

void KeptOnDevice::forget_body() {
  single_.reset();
  twofold_.reset();
}

std::optional<SteppingResult> KeptOnDevice::relax_if_asked(Body& body, const Course& course,
                                                           const SolveOptions& options, bool cautious,
                                                           const Progress& progress) {
  if (!fault_.empty() && options.device == Device::automatic) {
    return std::nullopt;
  }
  return relax_where_asked(backend_, body, course, options, progress, [&](const Backend& backend) {
    try {
      if (!course.settled) {  // once more, as a body that nothing is known of; two may not fit there
        forget_body();
        return relax(backend, body, course, options, cautious, progress);
      }
      return body.points.precision() == Precision::single_precision
                 ? relax(under_its_load(single_, backend, body), body, course, options, cautious, progress)
                 : relax(under_its_load(twofold_, backend, body), body, course, options, cautious, progress);
    } catch (const DeviceFault& fault) {
      fault_ = fault.what();
      forget_body();
      throw;
    }
  });
}

}  // namespace brainshift::solve::device
