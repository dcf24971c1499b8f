// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace brainshift::pipelines {

/// Begins to measure anew, where the system can (Linux).
void reset_peak_memory();

/// The most memory that this process held since the reset, MiB; since its start where there is no reset; 0 where the
/// system does not say.
double peak_memory_mb();

/// What the control groups of a process leave it, MiB, infinity without a limit; as processor_quota().
double memory_limit_mb(std::string_view groups, const std::filesystem::path& mount);

/// Memory that can be had without swapping, and that the control groups allow, MiB; infinite where the system does not
/// say.
double available_memory_mb();

}  // namespace brainshift::pipelines
