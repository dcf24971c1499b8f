// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/solve.hpp"

namespace brainshift::solve {

/// Throws std::invalid_argument when cells, contact or a material do not go with the plane, or when the steady state is
/// sought and the prescribed displacements leave the body free to move as a whole with no skull to stop it.
void check_model(const Model& model, Dynamics dynamics);

}  // namespace brainshift::solve
