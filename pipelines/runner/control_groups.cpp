// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/control_groups.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace brainshift::pipelines {

namespace {

namespace fs = std::filesystem;

bool names(std::string_view controllers, std::string_view controller) {
  std::istringstream stream{std::string(controllers)};
  for (std::string name; std::getline(stream, name, ',');) {
    if (name == controller) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::string own_control_groups() {
  std::ifstream file("/proc/self/cgroup");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

double smallest_limit(std::string_view groups, const fs::path& mount, std::string_view controller,
                      const std::function<double(const fs::path&)>& limit_of) {
  double smallest = no_limit;
  std::istringstream lines{std::string(groups)};
  for (std::string line; std::getline(lines, line);) {  // NUMBER:CONTROLLERS:/GROUP
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first == std::string::npos ? first : first + 1);
    if (second == std::string::npos) {
      continue;
    }
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && !names(controllers, controller)) {
      continue;
    }
    // A container may show a path of its host that is not there: the groups above it then decide.
    fs::path folder = mount / controllers;
    smallest = std::min(smallest, limit_of(folder));
    for (const fs::path& part : fs::path(line.substr(second + 1)).relative_path()) {
      folder /= part;
      smallest = std::min(smallest, limit_of(folder));
    }
  }
  return smallest;
}

}  // namespace brainshift::pipelines
