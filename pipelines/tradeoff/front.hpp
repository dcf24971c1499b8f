// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace brainshift::pipelines {

struct CostAndError {
  double seconds = 0;
  double error = 0;  ///< mm
};

/// The Pareto front: indices of those that are nearer, by a hundredth of the error at least, than all that are faster;
/// in the order of their seconds.
std::vector<std::size_t> pareto_front(std::span<const CostAndError> points);

}  // namespace brainshift::pipelines
