// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/warnings.hpp"

#include <cstdio>

namespace brainshift::pipelines {

std::string with_digits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, number < 99.5 ? "%.2g" : "%.0f", number);
  return text;
}

void append(const Warnings& more, Warnings& warnings) {
  warnings.insert(warnings.end(), more.begin(), more.end());
}

void warn(const Warnings& warnings, std::vector<std::string>& notes) {
  for (const std::string& warning : warnings) {
    notes.push_back("warning: " + warning);
  }
}

void warn(const Warnings& warnings, StageReport& report) {
  warn(warnings, report.notes);
}

}  // namespace brainshift::pipelines
