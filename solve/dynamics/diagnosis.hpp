// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solve/body/body.hpp"
#include "solve/force/force_scratch.hpp"

namespace brainshift::solve {

/// Where a run went wrong, in the numbers of the solver. Looked for after a failure only: a step pays nothing for it.
struct Fault {
  std::int32_t point = -1;  ///< integration point, in the order of the blocks; -1: none
  std::int32_t node = -1;   ///< -1: the one nearest to the point
  bool swings = false;      ///< there and back from step to step: the step is longer than the stiffness there allows
  bool fast = false;        ///< more energy of motion than of strain: the load came too fast
  bool explained = false;   ///< the failure's sentence has the cause already
};

/// û now, one and two steps ago.
struct LastSteps {
  const NodalVectors &now, &before, &earlier;
};

/// The point of least J at the last internal_force(), or one where J is not a number.
Fault broken_point(const PointBlocks& points, const ForceScratch& scratch, const LastSteps& steps);

/// A node whose û is not finite, else the one that is accelerated most.
Fault restless_node(const LastSteps& steps);

/// "at node 17, (1.2, 3.4, 5.6) mm; likely cause: ...": the node by the cloud's own number.
std::string describe(const Fault& fault, const Body& body);

}  // namespace brainshift::solve
