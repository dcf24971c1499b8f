// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/options/option.hpp"

namespace brainshift::solve {

/// When a cut whose file holds no times gets to its vertices. Nothing given: the body is cut from the start.
struct CutTiming {
  std::optional<double> start = {};  ///< in the time of the load's curve; absent beside a speed: 0
  std::optional<double> speed = {};  ///< mm in a unit of that time; absent: the whole cut is there at its start
  /// In which a sheet is cut at that speed, from its first vertex in this direction on; of any length. Zero: not given.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// Name, range, unit and help of each.
const OptionTable<CutTiming>& cut_timing_options();

/// One time a vertex, from how far along the cut it lies (mm, one a vertex); none where the body is cut from the start.
/// Throws std::invalid_argument, naming the cut, when the timing is out of range or has a direction without a speed.
std::vector<double> times_along(const std::vector<double>& distance, const CutTiming& timing, const std::string& name);

/// Throws std::invalid_argument, naming the cut, when a cut that holds its own times is also given a timing.
void refuse_timing(const CutTiming& timing, const std::string& name);

}  // namespace brainshift::solve
