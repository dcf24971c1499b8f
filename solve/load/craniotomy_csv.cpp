// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <charconv>
#include <fstream>
#include <stdexcept>

#include "segmentation/files/point_table.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {
CraniotomyLoad read_craniotomy_csv(const std::filesystem::path& file) {
  const PointTable table = read_point_table(file);
  return {.positions = vectors_in(table, "x", "y", "z"), .displacement = vectors_in(table, "ux", "uy", "uz")};
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
