// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/text_header.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <system_error>

#include "segmentation/files/refuse.hpp"

namespace brainshift {
namespace {

template <class Number>
std::vector<Number> values_in(const std::filesystem::path& file, const std::string& field, const std::string& text,
                              std::size_t count) {
  std::vector<Number> values;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    Number value{};
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc{} || end != word.data() + word.size()) {
      values.clear();
      break;
    }
    values.push_back(value);
  }
  if (values.size() != count) {
    refuse(file, "the header's " + field + " is not " + std::to_string(count) + " number(s); repair the header");
  }
  return values;
}

}  // namespace

TextHeader::TextHeader(const std::filesystem::path& file) : file_(file) {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 20;
  std::error_code unknown;
  text_.resize(static_cast<std::size_t>(std::min(longest, std::filesystem::file_size(file, unknown))));
  std::ifstream in(file, std::ios::binary);
  in.read(text_.data(), static_cast<std::streamsize>(text_.size()));
  text_.resize(static_cast<std::size_t>(in.gcount()));
}

std::string_view TextHeader::next_line() {
  const std::size_t end = text_.find('\n', place_);
  if (end == std::string::npos) {
    refuse(file_, "truncated within the header, or no image of the kind that its ending says; copy the file again");
  }
  std::string_view line = std::string_view(text_).substr(place_, end - place_);
  place_ = end + 1;
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  return line;
}

std::string HeaderFields::value(std::initializer_list<const char*> names) const {
  for (const char* name : names) {
    if (const auto found = values.find(name); found != values.end()) {
      return found->second;
    }
  }
  return {};
}

std::vector<double> numbers_in(const std::filesystem::path& file, const std::string& field, const std::string& text,
                               std::size_t count) {
  return values_in<double>(file, field, text, count);
}

std::vector<std::uint64_t> counts_in(const std::filesystem::path& file, const std::string& field,
                                     const std::string& text, std::size_t count) {
  return values_in<std::uint64_t>(file, field, text, count);
}

}  // namespace brainshift
