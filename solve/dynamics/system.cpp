// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/system.hpp"

#include <cmath>
#include <sstream>

namespace brainshift::solve {

std::string unsound(const PointState& state, double motion, int step, double fraction) {
  if (std::isfinite(motion) && state.smallest_jacobian > 0) {
    return {};
  }
  std::ostringstream text;
  text << "unstable at step " << step << " with " << 100 * fraction << " % of the load: ";
  if (std::isfinite(motion)) {
    text << "an integration point turned inside out (J = " << state.smallest_jacobian << ")";
  } else {
    text << "displacements are no longer finite";
  }
  text << "; the load is too large for this cloud, or a material too soft beside its neighbour";
  return text.str();
}

}  // namespace brainshift::solve
