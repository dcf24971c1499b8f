// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

namespace brainshift::pipelines {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// The text of /proc/self/cgroup; empty where the system has none.
std::string own_control_groups();

/// The smallest limit that the control groups of a process and the groups above them set, or no_limit.
/// `groups` is the text of /proc/PID/cgroup, `mount` the folder /sys/fs/cgroup, `controller` "cpu" or "memory"; both
/// versions of control groups are read (Linux, Documentation/admin-guide/cgroup-v2 and cgroup-v1). `limit_of` reads the
/// limit of one group's folder, no_limit where the folder sets none.
double smallest_limit(std::string_view groups, const std::filesystem::path& mount, std::string_view controller,
                      const std::function<double(const std::filesystem::path&)>& limit_of);

}  // namespace brainshift::pipelines
