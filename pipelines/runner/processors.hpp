// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace brainshift::pipelines {

/// How many processors' time the control groups of a process leave it: the smallest quota of its groups and of those
/// above them, infinity without a quota. `groups` is the text of /proc/PID/cgroup, `mount` the folder /sys/fs/cgroup;
/// both versions of control groups are read (Linux, Documentation/admin-guide/cgroup-v2, cpu.max; cgroup-v1,
/// cpu.cfs_quota_us).
double processor_quota(std::string_view groups, const std::filesystem::path& mount);

/// Threads for a process that may run on `allowed` processors with `quota` processors' time: at least 1.
int threads_for(int allowed, double quota);

/// Threads that this process can keep busy under taskset and control groups.
int available_threads();

}  // namespace brainshift::pipelines
