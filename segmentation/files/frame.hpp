// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include "segmentation/geometry/points.hpp"

namespace brainshift {

enum class Frame { lps, ras };

/// "LPS" or "RAS"; 3D Slicer's older codes 1 and 0 too. Nothing for anything else.
inline std::optional<Frame> frame_named(std::string_view name) {
  if (name == "LPS" || name == "1") {
    return Frame::lps;
  }
  if (name == "RAS" || name == "0") {
    return Frame::ras;
  }
  return std::nullopt;
}

/// What turns a vector of the frame to LPS, axis by axis, and back.
inline Eigen::Vector3d axes_to_lps(Frame frame) {
  return frame == Frame::ras ? Eigen::Vector3d(-1, -1, 1) : Eigen::Vector3d(1, 1, 1);
}

/// Positions or displacements in LPS.
inline void to_lps(Points& points, Frame frame) {
  if (frame == Frame::ras) {
    points.leftCols(2) *= -1;
  }
}

}  // namespace brainshift
