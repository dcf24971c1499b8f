// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "discretise/interface/background_cells.hpp"

namespace brainshift::solve {

/// The cells for which taken, one a cell, is `which`; all vertices stay.
BackgroundCells taken_cells(const BackgroundCells& cells, std::span<const std::uint8_t> taken, std::uint8_t which);

}  // namespace brainshift::solve
