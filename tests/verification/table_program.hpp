// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/files/write_text.hpp"

namespace brainshift {

/// A program of cases that print a table: PROGRAM [--small] [--out DIR] [CASE ...].
struct TableProgram {
  std::string program;
  std::string table;   ///< DIR/TABLE.md and DIR/TABLE.csv hold it
  std::string broken;  ///< what is said of rows that do not hold: "figures do not keep their bound"
};

struct TableArguments {
  bool small = false;
  std::filesystem::path out = {};       ///< empty: nothing is written
  std::vector<std::string> cases = {};  ///< none: all
};

/// cases: pairs of a name and what is run. Throws std::invalid_argument where a case is asked for that is not among
/// them.
template <class Cases>
TableArguments read_table_arguments(const std::vector<std::string>& words, const Cases& cases) {
  TableArguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--small") {
      arguments.small = true;
    } else if (words[i] == "--out" && i + 1 < words.size()) {
      arguments.out = words[++i];
    } else if (std::ranges::any_of(cases, [&](const auto& known) { return known.first == words[i]; })) {
      arguments.cases.push_back(words[i]);
    } else {
      throw std::invalid_argument("there is no case '" + words[i] + "'");
    }
  }
  return arguments;
}

/// main() of such a program. rows_of(name, case, arguments): a vector of rows; holds(row). What is there of the table
/// is written after each case. Returns 1 where a row does not hold, 2 after a fault.
template <class Cases, class RowsOf, class Holds>
int run_table_program(const TableProgram& about, const std::vector<std::string>& words, const Cases& cases,
                      const RowsOf& rows_of, const Holds& holds) {
  try {
    const TableArguments arguments = read_table_arguments(words, cases);
    decltype(rows_of(std::string(), std::begin(cases)->second, arguments)) rows;
    for (const auto& [name, run_case] : cases) {
      if (!arguments.cases.empty() && std::ranges::count(arguments.cases, std::string(name)) == 0) {
        continue;
      }
      std::fprintf(stderr, "%s ...\n", std::string(name).c_str());
      if (!arguments.out.empty()) {
        std::filesystem::create_directories(arguments.out);
      }
      std::ranges::copy(rows_of(name, run_case, arguments), std::back_inserter(rows));
      if (!arguments.out.empty()) {
        write_text(arguments.out / (about.table + ".md"), markdown_table(rows));
        write_text(arguments.out / (about.table + ".csv"), csv_table(rows));
      }
    }
    std::printf("%s", markdown_table(rows).c_str());
    const auto broken = std::ranges::count_if(rows, [&](const auto& row) { return !holds(row); });
    if (broken > 0) {
      std::printf("\n%d of %d %s\n", static_cast<int>(broken), static_cast<int>(rows.size()), about.broken.c_str());
    }
    return broken > 0 ? 1 : 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", about.program.c_str(), error.what());
    return 2;
  }
}

/// A number as printf() writes it, as "%.3g".
inline std::string table_number(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

inline std::string table_quoted(const std::string& text) {
  return '"' + text + '"';
}

}  // namespace brainshift
