// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/solve.hpp"

namespace brainshift::verification {

/// A finite-element reference: references/NAME.csv and, if there is one, its force curve.
struct Reference {
  Points positions, displacement;  ///< of NAME.csv, mm
  std::vector<double> travel;      ///< of NAME_force.csv, mm
  std::vector<double> force;       ///< N
  double converged_force = 0;      ///< N, by Richardson's extrapolation
  std::string error;               ///< what it says of its own error
};
Reference read_reference(const std::string& name, const std::string& force_name);

/// Rows of numbers of a CSV of the references, without comments and header.
std::vector<std::vector<double>> read_rows(const std::string& file);

/// The comment that starts with the key, without it; empty where there is none.
std::string comment_of(const std::string& file, const std::string& key);

/// u at points, mm.
Points displacement_at(const Solution& solution, const Points& positions);

/// |u − reference| at points, mm.
struct Differences {
  double largest = 0, percentile95 = 0, mean = 0;
};
Differences differences(const Solution& solution, const Points& positions, const Points& displacement);

}  // namespace brainshift::verification
