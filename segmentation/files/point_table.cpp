// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/point_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "segmentation/files/free_name.hpp"
#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/text_lines.hpp"
#include "segmentation/files/write_text.hpp"

namespace brainshift {

namespace {

/// 3D Slicer's own columns of a .fcsv.
const std::vector<std::string> fcsv_columns = {"id", "x",   "y",   "z",    "ow",    "ox",  "oy",
                                               "oz", "vis", "sel", "lock", "label", "desc"};

void read_frame(std::string_view name, std::size_t line, PointTable& table) {
  const std::optional<Frame> frame = frame_named(name);
  if (!frame) {
    fail_at_line(table.file, line, "the frame must be LPS or RAS, found \"" + std::string(name) + "\"");
  }
  if (table.frame && *table.frame != *frame) {
    fail_at_line(table.file, line, "the frame is named twice, differently");
  }
  table.frame = frame;
}

void read_columns(std::string_view names, std::size_t line, PointTable& table) {
  table.columns = split_fields(names);
  table.header = line - 1;
  for (const char* wanted : {"x", "y", "z"}) {
    if (!table.find_column(wanted)) {
      fail_at_line(table.file, line,
                   "a header with the columns x, y and z is expected, found \"" + std::string(names) + "\"");
    }
  }
}

/// value: "mm", "[cm]", "Millimetres (LPS)". What is no unit of length says nothing.
void check_unit(std::string_view value, std::size_t line, const PointTable& table) {
  constexpr auto others = std::to_array<std::string_view>(
      {"m", "metre", "metres", "meter", "meters", "cm", "centimetre", "centimetres", "centimeter", "centimeters", "um",
       "micrometre", "micrometres", "micrometer", "micrometers", "micron", "microns", "inch", "inches"});
  std::string unit = in_lower_case(std::string(value));
  unit.erase(0, std::min(unit.size(), unit.find_first_of("abcdefghijklmnopqrstuvwxyz")));
  unit.resize(std::min(unit.size(), unit.find_first_not_of("abcdefghijklmnopqrstuvwxyz")));
  if (std::ranges::find(others, unit) != others.end()) {
    fail_at_line(table.file, line, "the unit is " + unit + "; give millimetres");
  }
}

/// "# key: value" or "# key = value".
void read_comment(std::string_view text, std::size_t line, PointTable& table) {
  const std::size_t mark = text.find_first_of(":=");
  if (mark == std::string_view::npos) {
    return;
  }
  const std::string_view key = trimmed(text.substr(1, mark - 1)), value = trimmed(text.substr(mark + 1));
  if (key == "columns") {
    read_columns(value, line, table);
  } else if (key == "frame" || key == "CoordinateSystem") {
    read_frame(value, line, table);
  } else if (const std::string name = in_lower_case(std::string(key)); name == "unit" || name.starts_with("units")) {
    check_unit(value, line, table);
  }
}

/// The column's number, and that each row has it.
std::size_t column_in(const PointTable& table, const std::string& name) {
  const std::optional<std::size_t> column = table.find_column(name);
  if (std::ranges::count(table.columns, name) > 1) {
    fail_at_line(table.file, table.header + 1, "the column " + name + " stands here twice; take one of them out");
  }
  if (!column) {
    refuse(table.file, "the column \"" + name + "\" is missing");
  }
  return *column;
}

const std::string& field_in(const PointTable& table, const std::vector<std::string>& fields, std::size_t column,
                            std::size_t line) {
  if (column >= fields.size()) {
    fail_at_line(table.file, line, "a point with all its columns is expected, found \"" + table.lines[line - 1] + "\"");
  }
  return fields[column];
}

/// A row of a CSV has as many fields as its header: one more may be a decimal comma. Versions of 3D Slicer differ in
/// theirs.
void check_width(std::string_view text, std::size_t line, const PointTable& table) {
  const std::size_t fields = split_fields(text).size();
  if (ending_of(table.file) == ".csv" && fields != table.columns.size()) {
    fail_at_line(table.file, line,
                 std::to_string(table.columns.size()) + " columns are expected as in the header, found \"" +
                     std::string(text) + "\"");
  }
}

/// One more field at the end of a line.
void append_field(std::string& line, const std::string& field) {
  line += "," + field;
}

/// A field with words behind its own, within its quotes.
std::string with_words(std::string_view field, const std::string& words) {
  const bool quoted = field.size() > 1 && field.ends_with('"');
  std::string text(field.substr(0, field.size() - (quoted ? 1 : 0)));
  text += words.empty() || text.empty() || text == "\"" ? "" : "; ";
  return text + words + (quoted ? "\"" : "");
}

/// Six decimals, as fine as a file of points needs.
std::string decimal(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.6f", value);
  return text.data();
}

}  // namespace

std::optional<std::size_t> PointTable::find_column(std::string_view name) const {
  const auto place = std::find(columns.begin(), columns.end(), name);
  return place == columns.end() ? std::nullopt : std::optional(static_cast<std::size_t>(place - columns.begin()));
}

PointTable read_point_table(const std::filesystem::path& file) {
  PointTable table{.file = file, .lines = read_lines(file), .frame = {}, .columns = {}, .rows = {}};
  const bool is_csv = ending_of(file) == ".csv";
  if (!is_csv) {
    table.columns = fcsv_columns;
  }
  for (std::size_t i = 0; i < table.lines.size(); ++i) {
    const std::string_view text = trimmed(table.lines[i]);
    if (text.starts_with('#')) {
      read_comment(text, i + 1, table);
    } else if (!text.empty() && table.columns.empty()) {
      read_columns(text, i + 1, table);
    } else if (!text.empty()) {
      check_width(text, i + 1, table);
      table.rows.push_back(i);
    }
  }
  if (table.rows.empty()) {
    refuse(file, "holds no point; a line of numbers under a header with x,y,z is expected");
  }
  if (!table.frame) {
    refuse(file, is_csv ? "the frame is not named; add a line \"# frame: LPS\" or \"# frame: RAS\" at its beginning"
                        : "the frame is not named; a line \"# CoordinateSystem = LPS\" or RAS is expected");
  }
  return table;
}

Points vectors_in(const PointTable& table, const std::string& x, const std::string& y, const std::string& z) {
  const std::array<std::size_t, 3> columns = {column_in(table, x), column_in(table, y), column_in(table, z)};
  Points vectors(static_cast<Eigen::Index>(table.rows.size()), 3);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::size_t line = table.rows[row] + 1;
    const std::vector<std::string> fields = split_fields(table.lines[table.rows[row]]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      vectors(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(axis)) =
          parse_number(field_in(table, fields, columns[axis], line), table.file, line);
    }
  }
  to_lps(vectors, *table.frame);
  return vectors;
}

std::vector<std::string> texts_in(const PointTable& table, const std::string& name) {
  const std::size_t column = column_in(table, name);
  std::vector<std::string> texts;
  for (const std::size_t row : table.rows) {
    texts.push_back(field_in(table, split_fields(table.lines[row]), column, row + 1));
  }
  return texts;
}

void write_point_table(const std::filesystem::path& out, const PointTable& table, const Points& places,
                       const std::vector<PointValues>& values) {
  const bool is_csv = ending_of(table.file) == ".csv";
  const std::size_t description = is_csv ? std::string::npos : table.find_column("desc").value_or(std::string::npos);
  Points in_frame = places;
  to_lps(in_frame, *table.frame);  // the way there and back is the same
  std::vector<std::string> lines = table.lines;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    std::string& line = lines[table.rows[row]];
    std::vector<std::string_view> fields = split_raw_fields(line);
    std::array<std::string, 3> text;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      text[axis] = decimal(in_frame(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(axis)));
      fields[*table.find_column(std::string(1, "xyz"[axis]))] = text[axis];
    }
    std::string described;
    if (description < fields.size()) {
      described = with_words(fields[description], in_words(values, row));
      fields[description] = described;
    }
    std::string joined(fields.front());
    for (std::size_t f = 1; f < fields.size(); ++f) {
      joined.append(",").append(fields[f]);
    }
    line = std::move(joined);
  }
  for (const PointValues& each : is_csv ? values : std::vector<PointValues>{}) {
    append_field(lines[table.header],
                 free_name(each.name, [&](const std::string& name) { return table.find_column(name).has_value(); }));
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      append_field(lines[table.rows[row]], std::isnan(each.values[row]) ? "" : decimal(each.values[row]));
    }
  }
  const char* line_end = read_text(table.file).find("\r\n") == std::string::npos ? "\n" : "\r\n";
  std::string text;
  for (const std::string& line : lines) {
    text += line + line_end;
  }
  write_text(out, text);
}

}  // namespace brainshift
