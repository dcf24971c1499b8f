// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/text_lines.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace brainshift::solve {

std::string read_text(const std::filesystem::path& file) {
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown)) {
    throw std::invalid_argument(file.string() + ": is a folder, a file is expected");
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    throw std::invalid_argument(file.string() + ": cannot be read or is empty");
  }
  std::string content = std::move(text).str();
  if (content.starts_with("\xEF\xBB\xBF")) {
    content.erase(0, 3);
  }
  return content;
}

std::vector<std::string> read_lines(const std::filesystem::path& file) {
  std::istringstream text(read_text(file));
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

std::vector<std::string> split_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      const bool doubled = quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (doubled) {
        fields.back() += '"';
        ++i;
      } else {
        quoted = !quoted;
      }
    } else if (line[i] == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  for (std::string& field : fields) {
    field = std::string(trimmed(field));
  }
  return fields;
}

void fail_at_line(const std::filesystem::path& file, std::size_t line, const std::string& what) {
  throw std::invalid_argument(file.string() + ", line " + std::to_string(line) + ": " + what);
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

}  // namespace brainshift::solve
