// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "discretise/interface/node_cloud.hpp"
#include "solve/boundary/face_contact.hpp"
#include "solve/cut/inside_body.hpp"
#include "solve/interface/conditions.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

/// Nodes of a pair lie so far off their face, in spacings, one on each side.
constexpr double off_face = 1e-3;

/// Gives a cut's faces their nodes where they have none yet. Nodes within a third of the spacing of the cut are split
/// in two on it, at the mouth of a path, where it leaves the body, those of the surface within half of it; where there
/// are none, pairs are added, so that no place of the cut is a spacing away from the next. Both of a split node are
/// held as it was and take half its force each; a pair that is added within a patch that is held, each as its side of
/// it. None are put nearer than half a spacing to a front. Appends to the cloud, to the conditions where they have
/// rows, and to the pairs; returns how many were split.
std::size_t add_face_nodes(const CutFacets& cut, const InsideBody& inside, NodeCloud& cloud, Conditions& conditions,
                           std::vector<FacePair>& pairs);

/// The same for a septum, which must hold the tissue as far as its fronts: a row of pairs stands a quarter of a spacing
/// from each.
std::size_t add_septum_nodes(const CutFacets& septum, const InsideBody& inside, NodeCloud& cloud,
                             Conditions& conditions, std::vector<FacePair>& pairs);

}  // namespace brainshift::solve
