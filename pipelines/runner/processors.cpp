// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/processors.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "pipelines/runner/control_groups.hpp"

namespace brainshift::pipelines {

namespace {

namespace fs = std::filesystem;

/// Version 2 writes "50000 100000" or "max 100000" into one file, version 1 two numbers into two; -1 is no limit there.
double quota_of(const fs::path& group) {
  double quota = -1, period = 0;
  if (std::ifstream both(group / "cpu.max"); both) {
    both >> quota >> period;
  } else {
    std::ifstream(group / "cpu.cfs_quota_us") >> quota;
    std::ifstream(group / "cpu.cfs_period_us") >> period;
  }
  return quota > 0 && period > 0 ? quota / period : no_limit;
}

}  // namespace

double processor_quota(std::string_view groups, const fs::path& mount) {
  return smallest_limit(groups, mount, "cpu", quota_of);
}

int threads_for(int allowed, double quota) {
  return std::max(1, static_cast<int>(std::min<double>(allowed, std::ceil(quota))));
}

int available_threads() {
  return threads_for(omp_get_num_procs(), processor_quota(own_control_groups(), "/sys/fs/cgroup"));
}

}  // namespace brainshift::pipelines
