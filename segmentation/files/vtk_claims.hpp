// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "segmentation/files/deflated.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift {

/// Throws std::invalid_argument, naming the file, when a VTK XML file says to hold more points, cells or components, or
/// components of them all, than its length allows for even when compressed: VTK would allocate them.
inline void check_vtk_claims(const std::filesystem::path& file) {
  const std::uintmax_t most = most_deflated * std::filesystem::file_size(file);
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::string begin = "NumberOf";
  std::uintmax_t rows = 1, components = 1;  // the most of them
  for (std::size_t place = text.find(begin); place != std::string::npos; place = text.find(begin, place + 1)) {
    const auto is_letter = [](unsigned char sign) { return std::isalpha(sign) != 0; };
    const auto word = text.begin() + static_cast<std::ptrdiff_t>(place);
    const std::string name(word, std::find_if_not(word, text.end(), is_letter));
    const std::size_t sign = place + name.size();
    if (text.compare(sign, 2, "=\"") != 0 && text.compare(sign, 2, "='") != 0) {
      continue;
    }
    std::uintmax_t count = 0;
    const std::size_t digits = std::min(text.find_first_not_of(" \n", sign + 2), text.size());
    const auto [end, fault] = std::from_chars(text.data() + digits, text.data() + text.size(), count);
    if (fault != std::errc{} || count > most) {
      refuse(file, "says to hold more " + name.substr(begin.size()) + " than a file of its length can; copy it again");
    }
    std::uintmax_t& largest = name == "NumberOfComponents" ? components : rows;
    largest = std::max(largest, count);
    if (rows > most / components) {
      refuse(file, "says to hold more numbers than a file of its length can; copy it again");
    }
  }
}

}  // namespace brainshift
