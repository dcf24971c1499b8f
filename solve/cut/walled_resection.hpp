// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "solve/interface/model.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// What a resection leaves.
struct Resected {
  Model rest;  ///< with the nodes and cells that are left; those cells may still hold points to leave_out()
  ResectionMeasures measures;
};

/// resect() where a surface bounds what is taken out (Resection::wall) and the cells are parted by it: no cell has a
/// part on both sides, as discretise() makes them. Cells within it go, and nodes within it, with the load on those of
/// the cortex; nodes on it, within a thousandth of their spacing, become surface. Of what is left, the wall is the part
/// in the body, and the boundary, where the body's was known, that and the part of the body's outside the wall. Throws
/// std::invalid_argument when the wall encloses no cell or all of them, or as check_free() does of the others.
Resected resect_within_wall(const Model& model);

/// Throws std::invalid_argument, naming the node, when one that is taken out has a prescribed displacement or a force.
void check_free(const Model& model, std::span<const std::int32_t> gone);

}  // namespace brainshift::solve
