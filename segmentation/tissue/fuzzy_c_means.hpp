// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

namespace brainshift::segmentation {

/// Fuzzy c-means of scalar values with fuzziness 2 (Bezdek, Pattern Recognition with Fuzzy Objective Function
/// Algorithms, 1981), on a histogram, so that the cost does not grow with the image. The extreme thousandth of the
/// values at either end does not move the classes.
/// Returns the class centres, darkest first. Throws std::invalid_argument when classes < 2 or the values are too alike
/// to be told apart, or not finite.
std::vector<double> fuzzy_c_means(std::span<const float> values, int classes);

/// Membership of a value in each class, 0 to 1, sum 1. memberships: one a centre.
void fuzzy_memberships(std::span<const double> centres, double value, std::span<double> memberships);

}  // namespace brainshift::segmentation
