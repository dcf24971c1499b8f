// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "segmentation/files/readable_file.hpp"

namespace brainshift {

std::string read_text(const std::filesystem::path& file) {
  check_readable(file);
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    refuse(file, "cannot be read; copy it again");
  }
  std::string content = std::move(text).str();
  if (content.starts_with("\xEF\xBB\xBF")) {
    content.erase(0, 3);
  }
  return content;
}

std::vector<std::string> read_lines(const std::filesystem::path& file) {
  std::string all = read_text(file);
  if (all.find('\n') == std::string::npos) {  // the line ends of old Macs
    std::ranges::replace(all, '\r', '\n');
  }
  std::istringstream text(std::move(all));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (line.ends_with('\r')) {
      line.pop_back();
    }
    lines.push_back(line);
  }
  while (!lines.empty() && trimmed(lines.back()).empty()) {
    lines.pop_back();
  }
  if (lines.empty()) {
    throw std::invalid_argument(file.string() + ": is empty");
  }
  return lines;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string_view> split_raw_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i == line.size() || (line[i] == ',' && !quoted)) {
      fields.push_back(line.substr(begin, i - begin));
      begin = i + 1;
    } else if (line[i] == '"') {
      quoted = !quoted;  // a doubled quote leaves and enters again
    }
  }
  return fields;
}

std::vector<std::string> split_fields(std::string_view line) {
  std::vector<std::string> fields;
  for (const std::string_view raw : split_raw_fields(line)) {
    std::string field;
    bool quoted = false;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      if (raw[i] != '"') {
        field += raw[i];
      } else if (quoted && i + 1 < raw.size() && raw[i + 1] == '"') {
        field += raw[++i];
      } else {
        quoted = !quoted;
      }
    }
    fields.emplace_back(trimmed(field));
  }
  return fields;
}

std::string quoted_field(std::string_view text) {
  std::string field = "\"";
  for (const char c : text) {
    field.append(c == '"' ? 2 : 1, c);
  }
  return field + '"';
}

void fail_at_line(const std::filesystem::path& file, std::size_t line, const std::string& what) {
  throw std::invalid_argument(file.string() + ":" + std::to_string(line) + ": " + what);
}

double parse_number(const std::string& field, const std::filesystem::path& file, std::size_t line) {
  const char* first = field.data() + (field.starts_with('+') && !field.starts_with("+-") ? 1 : 0);
  const char* last = field.data() + field.size();
  double number = 0;
  const auto [end, fault] = std::from_chars(first, last, number);
  if (fault != std::errc{} || end != last || !std::isfinite(number)) {
    fail_at_line(file, line, "a finite number is expected, found \"" + field + "\"");
  }
  return number;
}

}  // namespace brainshift
