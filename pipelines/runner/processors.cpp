// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/processors.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>

namespace brainshift::pipelines {

namespace {

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Version 2 writes "50000 100000" or "max 100000" into one file, version 1 two numbers into two; -1 is no limit there.
double quota_of(const fs::path& group) {
  double quota = -1, period = 0;
  if (std::ifstream both(group / "cpu.max"); both) {
    both >> quota >> period;
  } else {
    std::ifstream(group / "cpu.cfs_quota_us") >> quota;
    std::ifstream(group / "cpu.cfs_period_us") >> period;
  }
  return quota > 0 && period > 0 ? quota / period : unlimited;
}

/// A container may show a path of its host that is not there: the groups above it then decide.
double smallest_quota(const fs::path& mount, const fs::path& group) {
  double smallest = quota_of(mount);
  fs::path folder = mount;
  for (const fs::path& part : group.relative_path()) {
    folder /= part;
    smallest = std::min(smallest, quota_of(folder));
  }
  return smallest;
}

bool names_cpu(std::string_view controllers) {
  std::istringstream names{std::string(controllers)};
  for (std::string name; std::getline(names, name, ',');) {
    if (name == "cpu") {
      return true;
    }
  }
  return false;
}

}  // namespace

double processor_quota(std::string_view groups, const fs::path& mount) {
  double smallest = unlimited;
  std::istringstream lines{std::string(groups)};
  for (std::string line; std::getline(lines, line);) {  // NUMBER:CONTROLLERS:/GROUP
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first == std::string::npos ? first : first + 1);
    if (second == std::string::npos) {
      continue;
    }
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (controllers.empty() || names_cpu(controllers)) {
      smallest = std::min(smallest, smallest_quota(mount / controllers, line.substr(second + 1)));
    }
  }
  return smallest;
}

int threads_for(int allowed, double quota) {
  return std::max(1, static_cast<int>(std::min<double>(allowed, std::ceil(quota))));
}

int available_threads() {
  std::ifstream file("/proc/self/cgroup");
  const std::string groups{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return threads_for(omp_get_num_procs(), processor_quota(groups, "/sys/fs/cgroup"));
}

}  // namespace brainshift::pipelines
