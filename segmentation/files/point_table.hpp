// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "segmentation/files/frame.hpp"
#include "segmentation/files/point_values.hpp"
#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// A text table of points: .csv, or 3D Slicer's .fcsv. Every line is kept as it was.
struct PointTable {
  std::filesystem::path file;
  std::vector<std::string> lines;
  std::optional<Frame> frame;        ///< as a comment names it: "# frame: LPS", "# CoordinateSystem = LPS"
  std::vector<std::string> columns;  ///< names, in the order of the fields
  std::size_t header = 0;            ///< the line that names them; without a meaning where none does
  std::vector<std::size_t> rows;     ///< lines that hold a point

  std::optional<std::size_t> find_column(std::string_view name) const;
};

/// Reads a table. The columns are named by the first line that is no comment (.csv) or by a comment "# columns =
/// id,x,y,z,…" (.fcsv; without it 3D Slicer's own). Throws std::invalid_argument with file and line where the frame is
/// not LPS or RAS (or 1, 0), is named twice differently or not at all, or no column is called x, y or z; with the file
/// where it cannot be read or holds no point.
PointTable read_point_table(const std::filesystem::path& file);

/// The finite numbers in three columns, (rows × 3), mm, in LPS. Throws std::invalid_argument with file and line.
Points vectors_in(const PointTable& table, const std::string& x, const std::string& y, const std::string& z);

/// The text in a column, one a row, without quotes. Throws as vectors_in().
std::vector<std::string> texts_in(const PointTable& table, const std::string& column);

/// Writes the table with the columns x, y and z replaced by places (rows × 3), mm, LPS, in the table's frame; all else
/// stays. A .csv gets the values as its last columns, "warp_" before the name of one that is there already, a .fcsv as
/// words in its description, where its rows have one. Throws std::runtime_error when it cannot be written whole.
void write_point_table(const std::filesystem::path& out, const PointTable& table, const Points& places,
                       const std::vector<PointValues>& values = {});

}  // namespace brainshift
