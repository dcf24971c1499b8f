// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/values.hpp"

#include <cmath>

namespace brainshift::pipelines {

bool Range::holds(double value) const {
  const bool above = low_allowed ? value >= low : value > low;
  const bool below = high_allowed ? value <= high : value < high;
  return std::isfinite(value) && above && below;
}

std::string describe(const Range& range, bool whole) {
  const std::string kind = whole ? "a whole number" : "a number";
  const bool has_low = std::isfinite(range.low);
  const bool has_high = std::isfinite(range.high);
  if (has_low && has_high && range.low_allowed && range.high_allowed) {
    return kind + " from " + write_number(range.low) + " to " + write_number(range.high);
  }
  std::string text = kind;
  if (has_low) {
    text += (range.low_allowed ? " >= " : " > ") + write_number(range.low);
  }
  if (has_high) {
    text += std::string(has_low ? " and" : "") + (range.high_allowed ? " <= " : " < ") + write_number(range.high);
  }
  return text;
}

}  // namespace brainshift::pipelines
