// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/progress/progress.hpp"
#include "solve/dynamics/stepping.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve::device {

struct Backend;
template <class Scalar>
class DeviceBody;

struct Relaxed {
  SteppingResult result;
  bool slow = false;  ///< relax() would look for its rigid modes, which a device does not: it is to go on from here
};

/// relax() once, with the masses from the bound itself where `cautious`, wholly on a device: after each window of steps
/// the host gets some sums, goes by the same rules, and says how to go on. Ends, to rounding, where and when relax()
/// does by BoundOf::parameters, but that HistoryRow::residual has the damping of the window, not of the next. body:
/// moved into the result; kept where it throws. Of a course without changes. Throws DeviceFault, and as
/// EssentialConditions::factorise() does.
Relaxed relax(const Backend& backend, Body& body, const Course& course, const SolveOptions& options, bool cautious,
              const Progress& progress);

/// The same of a body that lies there already, under its load, and stays there. It may have come to rest there before
/// where the course has settled masses; else it has not moved yet.
template <class Scalar>
Relaxed relax(DeviceBody<Scalar>& on, Body& body, const Course& course, const SolveOptions& options, bool cautious,
              const Progress& progress);

}  // namespace brainshift::solve::device
