// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solve/interface/solution.hpp"

namespace brainshift::verification {

/// A block from 0 to size that is cut in its middle, z = size.z / 2, from x = 0 to a front: as it is deformed, with
/// both faces of the cut, coloured by displacement, as SVG text. Seen from the mouth of the cut.
std::string picture_of_cut_block(const Solution& solution, const Eigen::Vector3d& size, double front);

}  // namespace brainshift::verification
