// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace brainshift {

/// A text table of numbers.
struct NumberTable {
  std::string header;                     ///< its columns' names, with a comma between two
  std::vector<std::vector<double>> rows;  ///< one number a column
  std::vector<std::size_t> line;          ///< of the file, from 1: one a row
};

/// The numbers under one of these headers, "time,factor"; lines that begin with # are passed over. Throws
/// std::invalid_argument, naming the file and the line, when the header is another, or a row holds more, fewer or other
/// things than a finite number a column.
NumberTable read_number_table(const std::filesystem::path& file, const std::vector<std::string>& headers);

}  // namespace brainshift
