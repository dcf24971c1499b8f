// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/peak_memory.hpp"

#include <fstream>
#include <string>

namespace brainshift::pipelines {

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    if (word == "VmHWM:") {
      double kilobytes = 0;
      status >> kilobytes;
      return kilobytes / 1024;
    }
  }
  return 0;
}

}  // namespace brainshift::pipelines
