// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"

namespace brainshift::solve {

/// The rigid motion that is nearest in squares to a motion of nodes: what moves slowest of a body that little holds, as
/// a brain in its skull, and what quicker motions hide.
class RigidPart {
 public:
  /// places: of the nodes, (n × 3) mm.
  explicit RigidPart(const Points& places);

  /// The farthest that it takes a node, mm, of the motion from one state to another.
  double longest(const NodalVectors& to, const NodalVectors& from) const;

 private:
  Points places_;  // about their middle, over their mean distance from it
  Eigen::LDLT<Eigen::Matrix<double, 6, 6>> factor_;
};

}  // namespace brainshift::solve
