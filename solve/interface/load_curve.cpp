// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/interface/load_curve.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "segmentation/files/number_table.hpp"
#include "segmentation/files/text_lines.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::solve {

double smooth_load(double tau) {
  const double t = std::clamp(tau, 0.0, 1.0);
  return t * t * t * (10 + t * (-15 + 6 * t));
}

namespace {

/// What is wrong with row i of the table, given the rows before it; empty: nothing.
std::string fault_of_row(std::span<const double> time, std::span<const double> factor, std::size_t i) {
  if (!std::isfinite(time[i]) || !std::isfinite(factor[i])) {
    return "time and factor must be finite";
  }
  constexpr double longest_time = 1e12, largest_factor = 1e6;
  if (time[i] > longest_time || std::abs(factor[i]) > largest_factor) {
    return "time must be at most " + write_number(longest_time) + ", and factor, of the load, from " +
           write_number(-largest_factor) + " to " + write_number(largest_factor);
  }
  if (i == 0 && (time[0] != 0 || factor[0] != 0)) {
    return "the load curve must start at time 0 with factor 0: the body starts at rest, unloaded";
  }
  if (i > 0 && time[i] <= time[i - 1]) {
    return "the time is not later than that of the row before";
  }
  return {};
}

}  // namespace

LoadCurve::LoadCurve(std::vector<double> time, std::vector<double> factor, Join join)
    : time_(std::move(time)), factor_(std::move(factor)), join_(join) {
  if (time_.size() < 2 || factor_.size() != time_.size()) {
    throw std::invalid_argument("a load curve needs at least two rows of time and factor");
  }
  for (std::size_t i = 0; i < time_.size(); ++i) {
    if (const std::string fault = fault_of_row(time_, factor_, i); !fault.empty()) {
      throw std::invalid_argument("row " + std::to_string(i + 1) + " of the load curve: " + fault);
    }
  }
}

double LoadCurve::largest() const {
  double most = 0;
  for (const double factor : factor_) {
    most = std::max(most, std::abs(factor));
  }
  return most;
}

double LoadCurve::at(double time) const {
  const auto after = std::upper_bound(time_.begin(), time_.end(), time);
  if (after == time_.begin()) {
    return factor_.front();
  }
  if (after == time_.end()) {
    return factor_.back();
  }
  const auto i = static_cast<std::size_t>(after - time_.begin());
  const double tau = (time - time_[i - 1]) / (time_[i] - time_[i - 1]);
  const double share = join_ == Join::smooth ? smooth_load(tau) : tau;
  return factor_[i - 1] + share * (factor_[i] - factor_[i - 1]);
}

LoadCurve read_load_curve(const std::filesystem::path& file, LoadCurve::Join join) {
  const NumberTable table = read_number_table(file, {"time,factor"});
  std::vector<double> time, factor;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    time.push_back(table.rows[i][0]);
    factor.push_back(table.rows[i][1]);
    if (const std::string fault = fault_of_row(time, factor, i); !fault.empty()) {
      fail_at_line(file, table.line[i], fault);
    }
  }
  try {
    return LoadCurve(std::move(time), std::move(factor), join);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(file.string() + ": " + error.what());
  }
}

}  // namespace brainshift::solve
