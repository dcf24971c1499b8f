// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/point_values.hpp"

#include <cmath>

#include "segmentation/options/values.hpp"

namespace brainshift {

std::string in_words(const std::vector<PointValues>& values, std::size_t point) {
  std::string text;
  for (const PointValues& each : values) {
    if (std::isnan(each.values[point])) {
      continue;
    }
    text += text.empty() ? "" : "; ";
    text += each.name + " " + write_number(std::round(1000 * each.values[point]) / 1000) + " mm";
  }
  return text;
}

}  // namespace brainshift
