// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace brainshift {

inline std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/// ".csv" of "POINTS.CSV".
inline std::string ending_of(const std::filesystem::path& file) {
  return in_lower_case(file.extension().string());
}

}  // namespace brainshift
