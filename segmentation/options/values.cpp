// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/options/values.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace brainshift {

bool Range::holds(double value) const {
  const bool above = low_allowed ? value >= low : value > low;
  const bool below = high_allowed ? value <= high : value < high;
  return std::isfinite(value) && above && below;
}

std::string with_decimals(double number, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << number;
  return text.str();
}

std::vector<std::string> split_words(std::string_view text) {
  constexpr std::string_view separators = " ,\t\n";
  std::vector<std::string> words;
  std::size_t begin = 0;
  while ((begin = text.find_first_not_of(separators, begin)) != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

std::string with_commas(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::optional<std::vector<std::uint16_t>> read_ranges(std::string_view text) {
  std::vector<std::uint16_t> labels;
  for (const std::string& word : split_words(text)) {
    const std::size_t dash = word.find('-');
    const auto first = read_number<int>(std::string_view(word).substr(0, dash));
    const auto last = dash == std::string::npos ? first : read_number<int>(std::string_view(word).substr(dash + 1));
    if (!first || !last || !label_numbers.holds(*first) || !label_numbers.holds(*last) || *first > *last) {
      return std::nullopt;
    }
    for (int label = *first; label <= *last; ++label) {
      labels.push_back(static_cast<std::uint16_t>(label));
    }
  }
  return labels;
}

std::optional<std::vector<std::pair<double, double>>> read_number_pairs(std::string_view text) {
  std::vector<std::pair<double, double>> pairs;
  if (text.find_first_not_of(" \t\n") == std::string_view::npos) {
    return pairs;
  }
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const auto numbers = read_numbers<double>(text.substr(begin, end - begin));
    if (!numbers || numbers->size() != 2) {
      return std::nullopt;
    }
    pairs.emplace_back((*numbers)[0], (*numbers)[1]);
    begin = end + 1;
  }
  return pairs;
}

namespace {

/// Whole numbers are written as such: 20000000 where a double would be 2e+07.
std::string write_end(double end) {
  return end == std::trunc(end) && std::abs(end) < 1e15 ? write_number(static_cast<long long>(end)) : write_number(end);
}

}  // namespace

std::string allowed_numbers(const std::string& kind, const Range& range) {
  const bool has_low = std::isfinite(range.low);
  const bool has_high = std::isfinite(range.high);
  if (has_low && has_high && range.low_allowed && range.high_allowed) {
    return kind + " from " + write_end(range.low) + " to " + write_end(range.high);
  }
  std::string text = kind;
  if (has_low) {
    text += (range.low_allowed ? " >= " : " > ") + write_end(range.low);
  }
  if (has_high) {
    text += std::string(has_low ? " and" : "") + (range.high_allowed ? " <= " : " < ") + write_end(range.high);
  }
  return text;
}

}  // namespace brainshift
