// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "segmentation/progress/progress.hpp"
#include "solve/dynamics/stepping.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve::device {

struct Backend;
template <class Scalar>
class DeviceBody;

/// A body in the memory of a device, where it stays from one load to the next: of a load go there what it prescribes
/// and, where it holds other nodes or has springs, their rows and the contact.
class KeptOnDevice {
 public:
  /// backend: nullptr: why_no_gpu() says why there is none.
  explicit KeptOnDevice(const Backend* backend);
  ~KeptOnDevice();

  /// As relax_if_asked(), of the same body each time but for its conditions and its contact, which at the same nodes
  /// are the same. Where the device has failed once, `auto` leaves all to the CPU from then on.
  std::optional<SteppingResult> relax_if_asked(Body& body, const Course& course, const SolveOptions& options,
                                               bool cautious, const Progress& progress);

  /// The next body is another.
  void forget_body();

  /// How the device has failed; empty: it has not.
  const std::string& fault() const { return fault_; }

 private:
  const Backend* backend_;
  std::unique_ptr<DeviceBody<float>> single_;
  std::unique_ptr<DeviceBody<double>> twofold_;  ///< in double precision
  std::string fault_;
};

}  // namespace brainshift::solve::device
