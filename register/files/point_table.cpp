// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "register/files/points_file.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

struct Table {
  std::vector<std::string> lines;
  std::vector<std::size_t> rows;                  ///< lines that hold a point
  std::vector<std::vector<std::string>> cells;    ///< one a row
  std::array<std::size_t, 3> column = {1, 2, 3};  ///< of x, y, z; .fcsv's unless the file says other
  double sign_xy = 0;                             ///< 1 LPS, -1 RAS, 0 not named yet
};

[[noreturn]] void fail(const fs::path& file, std::size_t line, const std::string& what) {
  throw std::invalid_argument(file.string() + ":" + std::to_string(line + 1) + ": " + what);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    cells.emplace_back(line.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return cells;
}

void read_columns(const fs::path& file, std::size_t line, std::string_view names, Table& table) {
  const std::vector<std::string> cells = split(names);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char wanted[] = {"xyz"[axis], '\0'};
    const auto found =
        std::find_if(cells.begin(), cells.end(), [&](const std::string& cell) { return trimmed(cell) == wanted; });
    if (found == cells.end()) {
      fail(file, line, "a header with the columns x, y and z is expected, found \"" + std::string(names) + "\"");
    }
    table.column[axis] = static_cast<std::size_t>(found - cells.begin());
  }
}

/// "# key: value" or "# key = value".
void read_comment(const fs::path& file, std::size_t line, std::string_view text, Table& table) {
  const std::size_t mark = text.find_first_of(":=");
  if (mark == std::string_view::npos) {
    return;
  }
  const std::string_view key = trimmed(text.substr(1, mark - 1)), value = trimmed(text.substr(mark + 1));
  if (key == "columns") {
    read_columns(file, line, value, table);
  } else if (key == "frame" || key == "CoordinateSystem") {
    table.sign_xy = value == "LPS" || value == "1" ? 1 : value == "RAS" || value == "0" ? -1 : 0;
    if (table.sign_xy == 0) {
      fail(file, line, "the frame must be LPS or RAS, found \"" + std::string(value) + "\"");
    }
  }
}

Table read_table(const fs::path& file) {
  std::ifstream in(file);
  if (!in) {
    throw std::invalid_argument(file.string() + ": cannot be opened; check the path");
  }
  Table table;
  bool header_follows = file.extension() == ".csv";
  for (std::string line; std::getline(in, line);) {
    const std::size_t number = table.lines.size();
    const std::string_view text = trimmed(line);
    if (text.starts_with('#')) {
      read_comment(file, number, text, table);
    } else if (!text.empty() && header_follows) {
      read_columns(file, number, text, table);
      header_follows = false;
    } else if (!text.empty()) {
      table.rows.push_back(number);
      table.cells.push_back(split(text));
    }
    table.lines.push_back(line);
  }
  if (table.rows.empty()) {
    throw std::invalid_argument(file.string() + ": holds no point; a line of numbers under a header x,y,z is expected");
  }
  if (table.sign_xy == 0) {
    throw std::invalid_argument(file.string() +
                                ": the frame is not named; add a line \"# frame: LPS\" or \"# frame: RAS\"");
  }
  return table;
}

double number_in(const fs::path& file, std::size_t line, const std::vector<std::string>& cells, std::size_t column) {
  const std::string_view text = column < cells.size() ? trimmed(cells[column]) : std::string_view();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty() || !std::isfinite(value)) {
    fail(file, line,
         "a finite number is expected in column " + std::to_string(column + 1) + ", found \"" + std::string(text) +
             "\"");
  }
  return value;
}

Points positions_of(const fs::path& file, const Table& table) {
  Points points(static_cast<Eigen::Index>(table.rows.size()), 3);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = number_in(file, table.rows[row], table.cells[row], table.column[axis]);
      points(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(axis)) =
          axis < 2 ? table.sign_xy * value : value;
    }
  }
  return points;
}

void set_positions(const Points& points, Table& table) {
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = points(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(axis));
      char text[64];
      std::snprintf(text, sizeof text, "%.6f", axis < 2 ? table.sign_xy * value : value);
      table.cells[row][table.column[axis]] = text;
    }
    std::string& line = table.lines[table.rows[row]];
    line.clear();
    for (const std::string& cell : table.cells[row]) {
      line += (line.empty() ? "" : ",") + cell;
    }
  }
}

}  // namespace

void copy_point_table(const fs::path& in, const fs::path& out, const MovePoints& move) {
  Table table = read_table(in);
  set_positions(move(positions_of(in, table)), table);
  std::ofstream file(out);
  for (const std::string& line : table.lines) {
    file << line << '\n';
  }
  if (!file.flush()) {
    throw std::runtime_error(out.string() + ": could not be written whole; is the disk full or the folder read-only?");
  }
}

}  // namespace brainshift::registration
