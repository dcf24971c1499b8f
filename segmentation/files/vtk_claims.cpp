// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/vtk_claims.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "segmentation/files/bytes_of_file.hpp"
#include "segmentation/files/deflated.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

/// Calls back with each place behind NAME=" or NAME=' in the text, and the name's own place.
template <class Use>
void for_each_attribute(std::string_view text, std::string_view begin, const Use& use) {
  for (std::size_t place = text.find(begin); place != std::string_view::npos; place = text.find(begin, place + 1)) {
    const auto is_letter = [](unsigned char sign) { return std::isalpha(sign) != 0; };
    const auto word = text.begin() + static_cast<std::ptrdiff_t>(place);
    const std::string_view name(word, std::find_if_not(word, text.end(), is_letter));
    const std::size_t sign = place + name.size();
    if (text.substr(sign, 2) == "=\"" || text.substr(sign, 2) == "='") {
      use(name, sign + 2);
    }
  }
}

/// A number >= 0 that begins at or behind a place. False where there is none.
bool read_count(std::string_view text, std::size_t place, std::uintmax_t& count) {
  const std::size_t digits = std::min(text.find_first_not_of(" \n", place), text.size());
  return std::from_chars(text.data() + digits, text.data() + text.size(), count).ec == std::errc{};
}

void check_sizes(const fs::path& file, std::string_view text) {
  const std::uintmax_t most = most_deflated * text.size();
  const std::string_view begin = "NumberOf";
  std::uintmax_t rows = 1, components = 1;  // the most of them
  for_each_attribute(text, begin, [&](std::string_view name, std::size_t place) {
    std::uintmax_t count = 0;
    if (!read_count(text, place, count) || count > most) {
      refuse(file, "says to hold more " + std::string(name.substr(begin.size())) +
                       " than a file of its length can; copy it again");
    }
    std::uintmax_t& largest = name == "NumberOfComponents" ? components : rows;
    largest = std::max(largest, count);
    if (rows > most / components) {
      refuse(file, "says to hold more numbers than a file of its length can; copy it again");
    }
  });
}

/// The first bytes of what is written in base64.
std::string decoded(std::string_view text, std::size_t bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  std::uint32_t bits = 0;
  int have = 0;
  for (const char sign : text) {
    const std::size_t value = digits.find(sign);
    if (value == std::string_view::npos || result.size() == bytes) {
      break;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    have += 6;
    if (have >= 8) {
      have -= 8;
      result += static_cast<char>(bits >> have & 0xff);
    }
  }
  return result;
}

/// How the numbers before an array's blocks are written: how many blocks, their size, that of the last.
struct BlockHeader {
  bool wide, big_endian;

  std::array<std::uintmax_t, 3> numbers(std::string_view text, bool base64) const {
    const std::size_t size = wide ? 8 : 4;
    const std::string bytes = base64 ? decoded(text, 3 * size) : std::string(text.substr(0, 3 * size));
    std::array<std::uintmax_t, 3> found{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::size_t place = i % size, at = big_endian ? size - 1 - place : place;
      found[i / size] |= std::uintmax_t{static_cast<unsigned char>(bytes[i])} << (8 * at);
    }
    return found;
  }
};

void check_blocks(const fs::path& file, std::string_view text) {
  const std::size_t appended = std::min(text.find("<AppendedData"), text.size());
  const std::string_view before = text.substr(0, appended), after = text.substr(appended);
  if (before.find("compressor=") == std::string_view::npos) {
    return;
  }
  const BlockHeader header{.wide = before.find("UInt64\"") < before.find('>', before.find("<VTKFile")),
                           .big_endian = before.find("BigEndian") != std::string_view::npos};
  const auto check = [&](std::string_view bytes, bool base64) {
    const auto [blocks, size, last] = header.numbers(bytes, base64);
    if (blocks > text.size() || std::max(size, last) > most_deflated * text.size()) {
      refuse(file, "an array of it says to hold more than a file of its length can; copy it again");
    }
  };
  const bool base64 = after.substr(0, after.find('>')).find("raw") == std::string_view::npos;
  const std::size_t data = after.find('_');
  for_each_attribute(before, "offset", [&](std::string_view, std::size_t place) {
    if (std::uintmax_t offset = 0;
        data < after.size() && read_count(before, place, offset) && offset < after.size() - data) {
      check(after.substr(data + 1 + offset), base64);
    }
  });
  for_each_attribute(before, "format", [&](std::string_view, std::size_t place) {
    const std::size_t begin =
        before.find_first_not_of(" \t\r\n", std::min(before.find('>', place), before.size() - 1) + 1);
    if (before.substr(place, 6) == "binary" && begin < before.size()) {
      check(before.substr(begin), true);
    }
  });
}

}  // namespace

void check_vtk_claims(const fs::path& file) {
  const std::string text = bytes_of_file(file);
  check_sizes(file, text);
  check_blocks(file, text);
}

}  // namespace brainshift
