// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/ordered_cloud.hpp"
#include "solve/solve.hpp"

namespace brainshift::solve {

/// Throws std::invalid_argument when two nodes lie nearly in one place, when cells, contact or a material do not go
/// with the plane, or when the steady state is sought and the cloud's prescribed displacements leave the body free to
/// move as a whole with no skull to stop it.
void check_model(const Model& model, const OrderedCloud& cloud, Dynamics dynamics);

}  // namespace brainshift::solve
