// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/tradeoff/sweep.hpp"

namespace brainshift::pipelines {

/// Which of the times a front is drawn over.
enum class TradeoffTime : std::uint8_t { solve, whole };

/// The front of pareto_front() in seconds and 95th percentile, as indices of sweep.points; failures are left out.
std::vector<std::size_t> front_of(const Sweep& sweep, TradeoffTime time);

/// A sentence for each point on the front.
std::string front_in_words(const Sweep& sweep, TradeoffTime time);

/// Writes tradeoff.csv (all points), tradeoff_solve.svg and tradeoff_run.svg (error over seconds), and tradeoff.md (the
/// fronts as table and in words). Throws std::runtime_error, naming the file, when one cannot be written.
void write_tradeoff(const std::filesystem::path& out, const Sweep& sweep);

}  // namespace brainshift::pipelines
