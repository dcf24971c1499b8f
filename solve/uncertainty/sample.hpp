// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/constants.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// A cloud of more nodes than so many is thinned for samples: its answer is another, but how that answers constants is
/// nearly the same (README.md).
inline constexpr std::size_t most_sampled_nodes = 2000;

/// The displacement of a model with each of these constants at its nodes, (n × 3) mm, solved together on the cloud or,
/// of a larger one, on an eighth of its nodes, for differences between such solutions. What was measured with noise
/// must name its weight. Absent where the model cannot be solved so. The same for any number of threads; to rounding a
/// sample does not depend on which others are asked for. Throws as check_sampled().
std::vector<std::optional<Points>> sampled_displacements(const Model& model, const SolveOptions& options,
                                                         std::span<const Constants> constants,
                                                         const Progress& progress = {});

/// So many are best asked for at once: the processor steps no more together, and a GPU solves these in about the time
/// that it takes to prepare the body for them.
std::size_t samples_at_once(const SolveOptions& options);

/// Throws std::invalid_argument with a part that samples do not go with: motion in time, a region, cuts, tears, a
/// septum, a resection, a plane problem.
void check_sampled(const Model& model, const SolveOptions& options);

/// The mean of (u − u₀)(u − u₀)ᵀ over samples u of one quantity, about the answer u₀ that is given, (n × 6) mm²: xx,
/// yy, zz, xy, yz, zx. About the answer, not their mean, as the answer is what is shown. No samples: zeros.
Eigen::MatrixXd spread_about(const Points& answer, const std::vector<Points>& samples);

}  // namespace brainshift::solve
