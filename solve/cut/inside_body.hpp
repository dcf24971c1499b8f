// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// Whether a place lies inside the body, as its integration points tell: one is as near as such points are apart.
class InsideBody {
 public:
  /// Integration points (n × 3) mm and their volumes, mm³; planar ones count as 1 mm thick.
  InsideBody(Points points, std::span<const double> volume, bool planar);
  bool operator()(const Eigen::Vector3d& x) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace brainshift::solve
