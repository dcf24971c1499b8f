// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cells/tetrahedra.hpp"

#include <algorithm>

#include "discretise/cloud/delaunay.hpp"
#include "discretise/cloud/tetrahedron.hpp"

namespace brainshift::discretise {
namespace {

/// A tetrahedron of less shape quality is left out.
constexpr double flattest = 1e-4;

/// More than half of twenty places spread evenly in it lie in the body.
bool mostly_inside(const TetrahedronCorners& x, const Scanlines& body) {
  int inside = 0;
  int looked = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; a + b < 4; ++b) {
      for (int c = 0; a + b + c < 4; ++c) {
        const Eigen::RowVector4d weight(a + 0.25, b + 0.25, c + 0.25, 3 - a - b - c + 0.25);
        inside += body.inside((weight / 4 * x).transpose()) ? 1 : 0;
        ++looked;
      }
    }
  }
  return 2 * inside > looked;
}

std::int32_t tissue_of(const TetrahedronCorners& x, std::span<const BodySide> sides) {
  const Eigen::Vector3d middle = x.colwise().mean().transpose();
  const auto side = sides.size() == 1
                        ? sides.begin()
                        : std::ranges::find_if(sides, [&](const BodySide& s) { return s.body.inside(middle); });
  return (side == sides.end() ? sides.front() : *side).tissue.tissue_at(middle);
}

}  // namespace

CellGrid inside_tetrahedra(const Points& nodes, const Scanlines& body, std::span<const BodySide> sides) {
  const auto tetrahedra = delaunay_tetrahedra(nodes);
  std::vector<std::int32_t> label(tetrahedra.size());
  std::vector<std::uint8_t> inside(tetrahedra.size());
  std::vector<std::uint8_t> flat(tetrahedra.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    const TetrahedronCorners x = corners_of(nodes, tetrahedra[t]);
    inside[t] = mostly_inside(x, body) ? 1 : 0;
    flat[t] = shape_quality(x) > flattest ? 0 : 1;
    label[t] = inside[t] != 0 ? tissue_of(x, sides) : 0;
  }
  CellGrid grid;
  BackgroundCells& cells = grid.cells;
  cells.kind = CellKind::tetrahedron;
  cells.vertices = nodes;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    if (inside[t] == 0) {
      continue;
    }
    if (flat[t] != 0) {
      ++grid.dropped_cells;
      grid.dropped_volume += volume_of(corners_of(nodes, tetrahedra[t]));
      continue;
    }
    cells.connectivity.insert(cells.connectivity.end(), tetrahedra[t].begin(), tetrahedra[t].end());
    cells.label.push_back(label[t]);
  }
  cells.inside_fraction.assign(cells.label.size(), 1.0);
  return grid;
}

}  // namespace brainshift::discretise
