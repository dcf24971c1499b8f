// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace brainshift {

/// The lines of a text file, without line ends (LF, CRLF or CR), byte order mark and blank lines at the end. Throws
/// std::invalid_argument, naming the file, when it cannot be read or is empty.
std::vector<std::string> read_lines(const std::filesystem::path& file);

/// The whole of a text file, without byte order mark. Throws as read_lines does.
std::string read_text(const std::filesystem::path& file);

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Fields between commas, trimmed; a field in double quotes may hold commas, and a quote as two.
std::vector<std::string> split_fields(std::string_view line);

/// The same fields as they stand in the line, with blanks and quotes.
std::vector<std::string_view> split_raw_fields(std::string_view line);

/// A field in double quotes, as split_fields() reads it.
std::string quoted_field(std::string_view text);

/// Throws std::invalid_argument: "FILE:N: what".
[[noreturn]] void fail_at_line(const std::filesystem::path& file, std::size_t line, const std::string& what);

/// A finite number, in the C locale. Throws as fail_at_line, naming the field, when the whole of it is not one.
double parse_number(const std::string& field, const std::filesystem::path& file, std::size_t line);

}  // namespace brainshift
