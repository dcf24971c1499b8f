// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "solve/load/craniotomy_load.hpp"
#include "solve/load/frame.hpp"
#include "solve/load/text_lines.hpp"

namespace brainshift::solve {
namespace {

const std::vector<std::string> columns = {"x", "y", "z", "ux", "uy", "uz"};

/// The frame that a comment line names, if it is such a line.
std::optional<Frame> frame_of_comment(const std::string& line, const std::filesystem::path& file, std::size_t number) {
  const std::string_view comment = trimmed(std::string_view(line).substr(1));
  constexpr std::string_view key = "frame:";
  if (!comment.starts_with(key)) {
    return std::nullopt;
  }
  const std::string_view name = trimmed(comment.substr(key.size()));
  if (name != "LPS" && name != "RAS") {
    fail_at_line(file, number, "the frame must be LPS or RAS, found \"" + std::string(name) + "\"");
  }
  return frame_named(name);
}

struct Start {
  Frame frame;
  std::size_t first_row;  ///< index of the line after the header
};

Start read_start(const std::vector<std::string>& lines, const std::filesystem::path& file) {
  std::optional<Frame> frame;
  std::size_t line = 0;
  for (; line < lines.size() && lines[line].starts_with('#'); ++line) {
    if (const auto named = frame_of_comment(lines[line], file, line + 1)) {
      if (frame && *frame != *named) {
        fail_at_line(file, line + 1, "the frame is named twice, differently");
      }
      frame = named;
    }
  }
  if (line == lines.size() || split_fields(lines[line]) != columns) {
    fail_at_line(file, line + 1, "the header x,y,z,ux,uy,uz is expected here");
  }
  if (!frame) {
    fail_at_line(file, line + 1, "a line \"# frame: LPS\" or \"# frame: RAS\" is expected before the header");
  }
  return {*frame, line + 1};
}

}  // namespace

CraniotomyLoad read_craniotomy_csv(const std::filesystem::path& file) {
  const std::vector<std::string> lines = read_lines(file);
  const Start start = read_start(lines, file);
  if (start.first_row == lines.size()) {
    throw std::invalid_argument(file.string() + ": holds no measurement after its header");
  }
  const auto rows = static_cast<Eigen::Index>(lines.size() - start.first_row);
  CraniotomyLoad load{Points(rows, 3), Points(rows, 3)};
  for (Eigen::Index row = 0; row < rows; ++row) {
    const std::size_t line = start.first_row + static_cast<std::size_t>(row);
    const std::vector<std::string> fields = split_fields(lines[line]);
    if (fields.size() != columns.size()) {
      fail_at_line(file, line + 1,
                   "six numbers x,y,z,ux,uy,uz are expected, found " + std::to_string(fields.size()) + " in \"" +
                       lines[line] + "\"");
    }
    for (int axis = 0; axis < 3; ++axis) {
      load.positions(row, axis) = parse_number(fields[axis], file, line + 1);
      load.displacement(row, axis) = parse_number(fields[3 + axis], file, line + 1);
    }
  }
  to_lps(load.positions, start.frame);
  to_lps(load.displacement, start.frame);
  return load;
}

void write_craniotomy_csv(const std::filesystem::path& file, const CraniotomyLoad& load) {
  std::ofstream stream(file, std::ios::binary);
  stream << "# frame: LPS\nx,y,z,ux,uy,uz\n";
  const auto write = [&](double number, char after) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    stream.write(text.data(), end - text.data()) << after;
  };
  for (Eigen::Index row = 0; row < load.positions.rows(); ++row) {
    for (int axis = 0; axis < 3; ++axis) {
      write(load.positions(row, axis), ',');
    }
    for (int axis = 0; axis < 3; ++axis) {
      write(load.displacement(row, axis), axis < 2 ? ',' : '\n');
    }
  }
  stream.close();
  if (!stream) {
    throw std::runtime_error(file.string() + ": cannot be written; is the disk full or the folder missing?");
  }
}

}  // namespace brainshift::solve
