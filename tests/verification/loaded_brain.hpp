// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/interface/model.hpp"

namespace brainshift::verification {

/// The brain of the finite-element reference with the reference's displacements prescribed; no materials yet. refined:
/// nodes at half the spacing within 10 mm of the surface that is moved.
solve::Model loaded_brain(std::size_t nodes, CellKind kind, bool refined = false);

}  // namespace brainshift::verification
