// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "register/warp/point_mover.hpp"
#include "segmentation/files/frame.hpp"
#include "segmentation/files/text_lines.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::registration {

/// The words of a line as they stand in it.
inline std::vector<std::string_view> words_in(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return words;
}

/// The line with the coordinates in three of its words moved; as it was where they do not move. `place`, where it is
/// given, becomes where they were, LPS. Throws std::invalid_argument with file and line where they are no finite
/// numbers.
inline std::string with_moved_words(const std::string& line, const std::array<std::size_t, 3>& places,
                                    const Eigen::Vector3d& to_lps, PointMover& mover, const std::filesystem::path& file,
                                    std::size_t number, Eigen::Vector3d* place = nullptr) {
  const std::vector<std::string_view> words = words_in(line);
  Eigen::Vector3d x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (places[axis] >= words.size()) {
      fail_at_line(file, number, "three coordinates are expected, found \"" + line + "\"");
    }
    x[static_cast<Eigen::Index>(axis)] = parse_number(std::string(words[places[axis]]), file, number);
  }
  const Eigen::Vector3d in_lps = to_lps.cwiseProduct(x);
  if (place != nullptr) {
    *place = in_lps;
  }
  const Eigen::Vector3d u = to_lps.cwiseProduct(mover.displacement(in_lps));
  if (u == Eigen::Vector3d::Zero()) {
    return line;
  }
  std::string moved;
  for (std::size_t w = 0; w < words.size(); ++w) {
    std::string word(words[w]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      word = places[axis] == w ? write_number(x[a] + u[a]) : word;
    }
    moved += (w == 0 ? "" : " ") + word;
  }
  return moved + (line.ends_with('\r') ? "\r" : "");
}

}  // namespace brainshift::registration
