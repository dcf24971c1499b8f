// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"

namespace brainshift::solve {

/// (n × 3) values at a cloud's nodes, in the order of a body. original: for each node of the body its number in the
/// cloud.
inline NodalVectors in_body_order(const Points& values, const std::vector<std::int32_t>& original) {
  NodalVectors ordered(4 * original.size(), 0.0);
  for (std::size_t a = 0; a < original.size(); ++a) {
    at(ordered, a).head<3>() = values.row(original[a]);
  }
  return ordered;
}

/// The way back, (n × 3).
inline Points in_cloud_order(const NodalVectors& values, const std::vector<std::int32_t>& original) {
  Points ordered(static_cast<Eigen::Index>(original.size()), 3);
  for (std::size_t a = 0; a < original.size(); ++a) {
    ordered.row(original[a]) = at(values, a).head<3>();
  }
  return ordered;
}

}  // namespace brainshift::solve
