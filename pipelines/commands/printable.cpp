// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/printable.hpp"

#include <algorithm>
#include <cstddef>

namespace brainshift::pipelines {
namespace {

// A file's name may have 4096 bytes, so that the longest sentence still names it.
constexpr std::size_t longest_begin = 4500, longest_end = 500;

bool continues(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
}

/// Bytes of the character that the text begins with; 0 where they are no UTF-8, or a control character.
std::size_t length_of_character(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  if (first < 0x80) {
    return first >= 0x20 && first != 0x7F ? 1 : 0;
  }
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  const bool whole = first >= 0xC2 && first <= 0xF4 && text.size() >= length &&
                     std::ranges::all_of(text.substr(1, length - 1), continues);
  const bool control = first == 0xC2 && whole && static_cast<unsigned char>(text[1]) < 0xA0;
  return whole && !control ? length : 0;
}

std::string without_middle(const std::string& text) {
  if (text.size() <= longest_begin + longest_end) {
    return text;
  }
  std::size_t begin = longest_begin, end = text.size() - longest_end;
  while (continues(text[begin])) {
    --begin;
  }
  while (continues(text[end])) {
    ++end;
  }
  return text.substr(0, begin) + " ... " + text.substr(end);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const std::size_t length = length_of_character(text);
    const bool blank = text.front() == '\n' || text.front() == '\r' || text.front() == '\t';
    line += length > 0 ? std::string(text.substr(0, length)) : blank ? " " : "?";
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return without_middle(line);
}

}  // namespace brainshift::pipelines
