// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// Numbers that go along with points, one a point: how far a place may be off, mm; NaN where that is not known.
struct PointValues {
  std::string name;
  std::vector<double> values;
};

/// The values at places (n × 3, mm, LPS): always those of the same names, in the same order.
using ValuesOfPoints = std::function<std::vector<PointValues>(const Points& places)>;

/// "estimated_error 0.12 mm; uncertainty 0.3 mm", for formats that have words alone: those of one point that are known.
std::string in_words(const std::vector<PointValues>& values, std::size_t point);

}  // namespace brainshift
