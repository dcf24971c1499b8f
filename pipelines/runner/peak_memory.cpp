// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/peak_memory.hpp"

#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace brainshift::pipelines {

namespace {

/// The kilobytes behind a word of one of the system's tables.
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

double available_memory_mb() {
  return megabytes_in("/proc/meminfo", "MemAvailable:").value_or(std::numeric_limits<double>::infinity());
}

}  // namespace brainshift::pipelines
