// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace brainshift::solve {

/// 3-4-5 polynomial s(τ) = 10τ³ − 15τ⁴ + 6τ⁵ on τ in [0, 1], clamped: zero velocity and acceleration at both ends.
double smooth_load(double tau);

/// The factor of the load over time: a table whose rows are joined by 3-4-5 polynomials or by straight lines. Before
/// the first row and after the last it stays what it is there.
class LoadCurve {
 public:
  enum class Join : std::uint8_t { smooth, straight };

  /// 0 to 1 in unit time by one 3-4-5 polynomial.
  LoadCurve() : LoadCurve({0, 1}, {0, 1}, Join::smooth) {}

  /// Times ascending, from 0 on, any unit; at least two. Throws std::invalid_argument, naming the row, where they are
  /// not, or a number is not finite or beyond what a load may be, or the first factor is not 0.
  LoadCurve(std::vector<double> time, std::vector<double> factor, Join join);

  double at(double time) const;
  double duration() const { return time_.back(); }
  /// The largest |factor|.
  double largest() const;

 private:
  std::vector<double> time_, factor_;
  Join join_;
};

/// A CSV with the header `time,factor`, lines that start with # aside. Throws std::invalid_argument, naming file and
/// line.
LoadCurve read_load_curve(const std::filesystem::path& file, LoadCurve::Join join);

}  // namespace brainshift::solve
