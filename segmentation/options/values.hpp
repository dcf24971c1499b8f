// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brainshift {

/// The numbers that an option may take.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = true;
  bool high_allowed = true;

  bool holds(double value) const;  ///< false for NaN and infinity
};
inline constexpr Range any_number{};
inline constexpr Range above_zero{.low = 0, .low_allowed = false};
inline constexpr Range not_negative{.low = 0};
inline constexpr Range label_numbers{.low = 1, .high = 65535};  ///< of tissues in label maps

/// "a number > 0", "a whole number from 1 to 8": the kind, then the range.
std::string allowed_numbers(const std::string& kind, const Range& range);

/// Reads the whole of the text as a number; nothing may follow it. Empty on failure.
template <class T>
std::optional<T> read_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return value;
}

/// The shortest text that reads back as the same number.
template <class T>
std::string write_number(T value) {
  char text[64];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return {text, result.ptr};
}

/// Of so many decimals, for sentences.
std::string with_decimals(double number, int decimals = 1);

/// Words separated by blanks or commas.
std::vector<std::string> split_words(std::string_view text);

/// "a, b, c".
std::string with_commas(const std::vector<std::string>& words);

/// Numbers separated by blanks or commas; empty on failure.
template <class T>
std::optional<std::vector<T>> read_numbers(std::string_view text) {
  std::vector<T> values;
  for (const std::string& word : split_words(text)) {
    const auto value = read_number<T>(word);
    if (!value) {
      return std::nullopt;
    }
    values.push_back(*value);
  }
  return values;
}

/// Labels and ranges of them, "2 3 10-13", one behind the other; empty where one is none of label_numbers.
std::optional<std::vector<std::uint16_t>> read_ranges(std::string_view text);

/// Pairs of numbers separated by semicolons, "a,b; a,b"; none in an empty text. Empty on failure.
std::optional<std::vector<std::pair<double, double>>> read_number_pairs(std::string_view text);

template <class Numbers>
std::string write_numbers(const Numbers& values) {
  std::string text;
  for (const auto value : values) {
    text += text.empty() ? "" : " ";
    text += write_number(value);
  }
  return text;
}

}  // namespace brainshift
