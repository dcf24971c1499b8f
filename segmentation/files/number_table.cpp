// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/number_table.hpp"

#include <algorithm>

#include "segmentation/files/text_lines.hpp"

namespace brainshift {
namespace {

std::string joined(const std::vector<std::string>& parts, const std::string& between) {
  std::string text;
  for (const std::string& part : parts) {
    text += (text.empty() ? "" : between) + part;
  }
  return text;
}

}  // namespace

NumberTable read_number_table(const std::filesystem::path& file, const std::vector<std::string>& headers) {
  const std::vector<std::string> lines = read_lines(file);
  NumberTable table;
  std::size_t columns = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with('#')) {
      continue;
    }
    const std::vector<std::string> fields = split_fields(lines[i]);
    if (columns == 0) {
      columns = fields.size();
      table.header = joined(fields, ",");
      if (std::ranges::find(headers, table.header) == headers.end()) {
        fail_at_line(file, i + 1, "the header " + joined(headers, " or ") + " is expected here");
      }
      continue;
    }
    if (fields.size() != columns) {
      fail_at_line(file, i + 1,
                   std::to_string(columns) + " numbers " + table.header + " are expected, found \"" + lines[i] + "\"");
    }
    std::vector<double>& row = table.rows.emplace_back();
    for (const std::string& field : fields) {
      row.push_back(parse_number(field, file, i + 1));
    }
    table.line.push_back(i + 1);
  }
  if (columns == 0) {
    fail_at_line(file, lines.size() + 1, "the header " + joined(headers, " or ") + " is expected here");
  }
  return table;
}

}  // namespace brainshift
