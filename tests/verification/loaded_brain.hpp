// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/discretise.hpp"

namespace brainshift::verification {

/// Cloud and cells of the brain of the finite-element reference, with the reference's displacements prescribed, mm: NaN
/// where the surface is free. refined: nodes at half the spacing within 10 mm of the surface that is moved.
discretise::Discretisation loaded_brain(std::size_t nodes, CellKind kind, bool refined = false);

}  // namespace brainshift::verification
