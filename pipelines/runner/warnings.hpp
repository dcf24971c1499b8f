// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipelines/runner/stage_report.hpp"

namespace brainshift::pipelines {

/// What is no fault, but most likely not what the user means: a sentence each.
using Warnings = std::vector<std::string>;

void append(const Warnings& more, Warnings& warnings);

/// Two digits, of large numbers all before the point.
std::string with_digits(double number);

/// Adds them to the notes of a stage, each marked as a warning.
void warn(const Warnings& warnings, std::vector<std::string>& notes);
void warn(const Warnings& warnings, StageReport& report);

}  // namespace brainshift::pipelines
