// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/shape/shape_rows.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

/// What changes when a cut goes on.
struct Advance {
  const Visibility& fresh;              ///< what is newly cut, alone
  std::span<const std::int32_t> nodes;  ///< that are new or moved
  const Points& positions;              ///< of all nodes, as they are now, mm
  std::span<const double> radius;       ///< of their supports, mm
};

/// Rows whose support may change, ascending: a line of sight may meet what is newly cut or pass its old tip, or a node
/// is new or moved. points (m × 3): where the rows are.
std::vector<std::int32_t> touched_rows(const ShapeRows& rows, const Points& points, const Advance& advance);

}  // namespace brainshift::solve
