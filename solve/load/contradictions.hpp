// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {

/// Standard deviations of a point from what others say that are surprising, over what is usual of the load: 60 points
/// of a Gaussian have one in a thousand runs.
inline constexpr double surprising = 5;

/// The median of that distance where the noise is Gaussian: of the root of chi-squared with three degrees of freedom.
inline constexpr double usual_surprise = 1.54;

/// Where what was measured contradicts itself.
struct Outlier {
  Eigen::Vector3d position;  ///< undeformed, of the measured point, mm
  double deviations;         ///< standard deviations from what the others say, over what is usual of this load
};

/// Measured points that contradict the others.
struct LessenedPoints {
  Points positions = Points(0, 3);  ///< of those that keep less than half of their weight, undeformed, mm
  Eigen::Index all = 0;             ///< points that were looked at
};

/// Of the measured points that joined() would join, the one that is farthest from the mean of the others with which it
/// is joined, where that is more than five standard deviations of their distance, and five times farther than is usual
/// of this load. Their mean would hide it from outliers(). load: with standard deviations; inner: the rows of points
/// inside the brain, ascending, which are joined by themselves.
std::optional<Outlier> worst_of_joined(const CraniotomyLoad& load, const std::vector<Eigen::Index>& inner = {});

/// Raises the standard deviations of such points until none is left, so that they hardly count in the mean; of two in
/// one place that contradict each other those of both, as nothing says which is wrong.
LessenedPoints lessen_joined(CraniotomyLoad& load, const std::vector<Eigen::Index>& inner = {});

}  // namespace brainshift::solve
