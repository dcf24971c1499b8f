// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <string>
#include <string_view>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/not_written.hpp"
#include "segmentation/files/point_table.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/text_lines.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {

namespace {

/// The standard deviations of a table's points, mm; no rows where it has no column for them.
Points sigma_in(const PointTable& table) {
  const bool one = table.find_column("sigma").has_value();
  const bool each = table.find_column("sigma_x") || table.find_column("sigma_y") || table.find_column("sigma_z");
  for (const std::string& column : table.columns) {
    constexpr std::array<std::string_view, 4> read = {"sigma", "sigma_x", "sigma_y", "sigma_z"};
    constexpr std::array<std::string_view, 5> alike = {"sigma", "sd", "std", "standard", "noise"};
    const std::string name = in_lower_case(column);
    if (std::ranges::find(read, column) == read.end() &&
        std::ranges::any_of(alike, [&](std::string_view word) { return name.starts_with(word); })) {
      refuse(table.file, "its column '" + column +
                             "' is not read; name standard deviations sigma, or sigma_x, sigma_y "
                             "and sigma_z, or take it out");
    }
  }
  if (one && each) {
    refuse(table.file,
           "it has a column sigma and one of sigma_x, sigma_y, sigma_z, too; take the one or the others out");
  }
  if (!one && !each) {
    return Points(0, 3);
  }
  const std::array<std::string, 3> columns = one ? std::array<std::string, 3>{"sigma", "sigma", "sigma"}
                                                 : std::array<std::string, 3>{"sigma_x", "sigma_y", "sigma_z"};
  Points sigma = vectors_in(table, columns[0], columns[1], columns[2]);
  to_lps(sigma, *table.frame);  // the way back: a standard deviation has no direction
  for (Eigen::Index row = 0; row < sigma.rows(); ++row) {
    if (!(sigma.row(row).minCoeff() >= smallest_noise)) {
      fail_at_line(table.file, table.rows[static_cast<std::size_t>(row)] + 1,
                   "the standard deviation of a point must be 0.000001 mm or more, found " +
                       table.lines[table.rows[static_cast<std::size_t>(row)]] +
                       "; leave the column out where points are to be met exactly");
    }
  }
  return sigma;
}

}  // namespace

CraniotomyLoad read_craniotomy_csv(const std::filesystem::path& file) {
  const PointTable table = read_point_table(file);
  return {.positions = vectors_in(table, "x", "y", "z"),
          .displacement = vectors_in(table, "ux", "uy", "uz"),
          .sigma = sigma_in(table)};
}

void write_craniotomy_csv(const std::filesystem::path& file, const CraniotomyLoad& load) {
  std::ofstream stream(file, std::ios::binary);
  const bool noisy = load.sigma.rows() > 0;
  stream << "# frame: LPS\nx,y,z,ux,uy,uz" << (noisy ? ",sigma_x,sigma_y,sigma_z\n" : "\n");
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
      write(load.displacement(row, axis), axis < 2 || noisy ? ',' : '\n');
    }
    for (int axis = 0; axis < 3 && noisy; ++axis) {
      write(load.sigma(row, axis), axis < 2 ? ',' : '\n');
    }
  }
  stream.close();
  if (!stream) {
    fail_to_write(file);
  }
}

}  // namespace brainshift::solve
