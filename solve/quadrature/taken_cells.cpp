// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/taken_cells.hpp"

namespace brainshift::solve {

BackgroundCells taken_cells(const BackgroundCells& cells, std::span<const std::uint8_t> taken, std::uint8_t which) {
  BackgroundCells part;
  part.kind = cells.kind;
  part.vertices = cells.vertices;
  const auto corners = static_cast<std::size_t>(cells.corners());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (taken[i] != which) {
      continue;
    }
    const auto first = cells.connectivity.begin() + static_cast<std::ptrdiff_t>(corners * i);
    part.connectivity.insert(part.connectivity.end(), first, first + static_cast<std::ptrdiff_t>(corners));
    part.inside_fraction.push_back(cells.inside_fraction[i]);
    part.label.push_back(cells.label[i]);
    if (!cells.cut_index.empty()) {
      const std::int32_t cut = cells.cut_index[i];
      part.cut_index.push_back(cut < 0 ? -1 : static_cast<std::int32_t>(part.cut_parts.size()));
      if (cut >= 0) {
        part.cut_parts.push_back(cells.cut_parts[static_cast<std::size_t>(cut)]);
      }
    }
  }
  return part;
}

}  // namespace brainshift::solve
