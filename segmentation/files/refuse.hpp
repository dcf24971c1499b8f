// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace brainshift {

/// Throws std::invalid_argument: "FILE: why".
[[noreturn]] inline void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::invalid_argument(file.string() + ": " + why);
}

}  // namespace brainshift
