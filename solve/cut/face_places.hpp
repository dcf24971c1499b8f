// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "discretise/interface/node_cloud.hpp"
#include "solve/boundary/face_contact.hpp"
#include "solve/cut/inside_body.hpp"
#include "solve/interface/cut.hpp"

namespace brainshift::solve {

inline constexpr std::int32_t no_node = -1;     ///< in place of one's row
inline constexpr double next_on_surface = 1.6;  ///< spacings: so near are neighbours on the body's surface

/// Where a pair of nodes goes on a face of the undeformed body.
struct PairPlace {
  std::int32_t node;          ///< that is split; no_node: two are added
  std::int32_t like;          ///< the nearest node
  Eigen::Vector3d x, normal;  ///< mm; of the face, a unit vector
};

/// Where the faces of a cut need pairs, add_face_nodes(): those of split nodes first, the surface's before the others;
/// in a plane those at the mouths before them. pairs: that the cut has already, of nodes of the cloud.
std::vector<PairPlace> face_places(const CutFacets& cut, const InsideBody& inside, const NodeCloud& cloud,
                                   const std::vector<FacePair>& pairs);

/// The same for a septum, add_septum_nodes(): the row along its fronts first; none near where it branches.
std::vector<PairPlace> septum_places(const CutFacets& septum, const InsideBody& inside, const NodeCloud& cloud,
                                     const std::vector<FacePair>& pairs);

}  // namespace brainshift::solve
