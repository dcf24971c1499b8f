// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "segmentation/files/point_values.hpp"
#include "segmentation/geometry/points.hpp"

namespace brainshift {

/// A file of points, read by its ending: 3D Slicer's markups (.mrk.json, .fcsv) or a table (.csv). What else is in it
/// is kept, so that it can be written again with its points moved.
class PointsFile {
 public:
  /// A .mrk.json that names no frame is in LPS, as 3D Slicer's schema has it; a table must name its frame. Throws
  /// std::invalid_argument, naming file and line or point, where something does not parse, is not finite or not in mm,
  /// or the file holds no point that is placed.
  explicit PointsFile(const std::filesystem::path& file);

  /// Of the points that are placed, (n × 3), mm, LPS, in the file's order.
  const Points& positions() const { return positions_; }
  /// One a placed point; empty where the file gives none.
  const std::vector<std::string>& labels() const { return labels_; }
  /// Names of the points that are not placed (3D Slicer's positionStatus).
  const std::vector<std::string>& not_placed() const { return not_placed_; }
  /// Markup lists in the file; 1 for a table.
  std::size_t lists() const { return lists_; }

  /// Copies the file with its placed points at other places (n × 3), mm, LPS. The values become columns of a .csv, and
  /// words of a point's description in 3D Slicer's markups. Throws std::runtime_error when it cannot be written whole.
  void write_moved(const std::filesystem::path& out, const Points& places,
                   const std::vector<PointValues>& values = {}) const;

  struct Content;

 private:
  Points positions_;
  std::vector<std::string> labels_, not_placed_;
  std::size_t lists_ = 1;
  std::shared_ptr<const Content> content_;
};

/// Whether a file's name ends as one that PointsFile reads.
bool is_points_file(const std::filesystem::path& file);

}  // namespace brainshift
