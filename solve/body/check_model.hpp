// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/body/ordered_cloud.hpp"
#include "solve/interface/model.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// What must hold before anything of a model is read: arrays of one length, indices within them, finite numbers,
/// materials within their range. Throws std::invalid_argument.
void check_input(const Model& model);

/// Throws std::invalid_argument when plane, cells and materials do not go together, the resection is out of range, or
/// nodes lie in one place.
void check_model(const Model& model);

/// Whether anything but prescribed displacements acts on the body: gravity, fluid that drains, forces at nodes, in the
/// volume or on the wall of a cavity, or tissue that swells.
bool is_pushed(const Model& model);

/// Throws std::invalid_argument when the conditions leave the body free to move as a whole.
void check_held(const OrderedCloud& cloud, const Model& model);
/// contact: of a skull; pushed: forces act, against which it may be enough.
void check_held(const OrderedCloud& cloud, Plane plane, bool contact, bool pushed);

/// The same of each part of a body that a cut or a resection leaves in two or more. point_rows: shape functions of the
/// integration points, which hold a part together.
void check_parts_held(const OrderedCloud& cloud, const ShapeRows& point_rows, const Model& model);

}  // namespace brainshift::solve
