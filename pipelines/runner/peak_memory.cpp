// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/peak_memory.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

#include "pipelines/runner/control_groups.hpp"

namespace brainshift::pipelines {

namespace {

/// The kilobytes behind a word of one of the system's tables, as MiB.
std::optional<double> megabytes_in(const char* table, const std::string& name) {
  std::ifstream stream(table);
  for (std::string word; stream >> word;) {
    if (double kilobytes = 0; word == name && stream >> kilobytes) {
      return kilobytes / 1024;
    }
  }
  return std::nullopt;
}

}  // namespace

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_memory_mb() {
  return megabytes_in("/proc/self/status", "VmHWM:").value_or(0);
}

double memory_limit_mb(std::string_view groups, const std::filesystem::path& mount) {
  return smallest_limit(groups, mount, "memory", [](const std::filesystem::path& group) {
    for (const char* name : {"memory.max", "memory.limit_in_bytes"}) {  // "max", or nearly 2^63, is no limit
      if (double bytes = 0; std::ifstream(group / name) >> bytes) {
        return bytes / (1024 * 1024);
      }
    }
    return no_limit;
  });
}

double available_memory_mb() {
  return std::min(megabytes_in("/proc/meminfo", "MemAvailable:").value_or(no_limit),
                  memory_limit_mb(own_control_groups(), "/sys/fs/cgroup"));
}

}  // namespace brainshift::pipelines
