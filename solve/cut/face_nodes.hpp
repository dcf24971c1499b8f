// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "discretise/node_cloud.hpp"
#include "solve/cut/inside_body.hpp"
#include "solve/cut/visibility.hpp"

namespace brainshift::solve {

/// Two nodes at one place of a cut, a thousandth of the spacing off it: one on each face.
struct FacePair {
  std::int32_t above;  ///< on the side of the normal
  std::int32_t below;
  Eigen::Vector3d place;   ///< mm
  Eigen::Vector3d normal;  ///< of the cut, a unit vector
};

/// Gives a cut's faces their nodes where they have none yet. Nodes within a third of the spacing of the cut are split
/// in two on it, at the mouth of a path, where it leaves the body, those of the surface within half of it; where there
/// are none, pairs are added, so that they are at most a spacing apart. Both of a split node are held as it was and
/// take half its force each. None are put nearer than half a spacing to a front. Appends to the cloud and to the pairs;
/// returns how many were split.
std::size_t add_face_nodes(const CutFacets& cut, const InsideBody& inside, NodeCloud& cloud,
                           std::vector<FacePair>& pairs);

}  // namespace brainshift::solve
