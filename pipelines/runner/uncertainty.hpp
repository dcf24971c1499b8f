// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipelines/runner/stage_report.hpp"
#include "solve/solve.hpp"
#include "solve/uncertainty/uncertainty_options.hpp"

namespace brainshift::pipelines {

/// That the answer's uncertainty is wanted.
struct UncertaintyJob {
  solve::UncertaintyOptions options;
  std::filesystem::path samples;                ///< folder where finished samples lie from run to run
  std::map<std::int32_t, std::string> tissues;  ///< names, by label
};

/// A finished solution, and of what.
struct Solved {
  const solve::Model& model;
  const solve::SolveOptions& options;
  const solve::SolveResult& result;
};

/// How far the displacement may be off.
struct Spread {
  Eigen::MatrixXd noise;  ///< (nodes × 6) mm²: xx, yy, zz, xy, yz, zx, by what is measured; zeros of an exact load
  Eigen::MatrixXd constants;  ///< (nodes × 6) mm², by constants that nobody knows
};

/// Draws the samples of a finished solution, solves those that are not kept in job.samples from an earlier run, and
/// keeps each when it is whole. Writes uncertainty.vtu (point arrays uncertainty, from_noise and from_constants, mm,
/// and covariance) and samples.csv into `out`; adds to what the stage says. Samples do not depend on the order in which
/// they are solved nor on the number of threads. Throws std::invalid_argument where the model has a part that samples
/// do not go with.
Spread write_spread(const UncertaintyJob& job, const Solved& solved, const std::filesystem::path& out,
                    StageReport& said, const Progress& progress);

/// uncertainty.csv: places (m × 3) and the covariance (mm²) of the displacement there, by what is measured and by
/// constants (nodes × 6; no rows: they count as known); empty outside the brain. Throws std::runtime_error, naming the
/// file, when it cannot be written whole.
void write_covariance(const std::filesystem::path& file, const Points& places, const solve::SolveResult& result,
                      const Eigen::MatrixXd& constants = {});

/// √(xx + yy + zz) of each row, mm: how far off in space, root mean square.
std::vector<double> deviations(const Eigen::MatrixXd& covariance);

}  // namespace brainshift::pipelines
