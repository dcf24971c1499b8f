// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cells/hexahedra.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "discretise/cells/cut_cell.hpp"

namespace brainshift::discretise {
namespace {

/// A cut cell with less of its volume inside is left out.
constexpr double negligible_cell = 0.001;
/// More of it inside counts as whole.
constexpr double whole_cell = 1 - 1e-9;
/// A cell is split at most so often.
constexpr int deepest_level = 3;
/// Finest grid lines between two of the base grid's.
constexpr std::int64_t subdivisions = 1 << deepest_level;

/// The base grid: cubes of one edge over the body's box, centred on it.
struct Lattice {
  Eigen::Vector3d origin;
  double edge;
  Eigen::Array<std::int64_t, 3, 1> size;

  double fine_edge() const { return edge / static_cast<double>(subdivisions); }
  std::int64_t cells() const { return size.prod(); }
  Eigen::Vector3d corner(const Eigen::Array<std::int64_t, 3, 1>& fine) const {
    return origin + fine_edge() * fine.cast<double>().matrix();
  }
};
using Fine = Eigen::Array<std::int64_t, 3, 1>;

Lattice make_lattice(const Surface& surface, double edge) {
  const Eigen::Vector3d low = surface.vertices.colwise().minCoeff();
  const Eigen::Vector3d high = surface.vertices.colwise().maxCoeff();
  const Fine size = ((high - low) / edge).array().ceil().cast<std::int64_t>().max(1);
  const Eigen::Vector3d excess = edge * size.cast<double>().matrix() - (high - low);
  return {low - 0.5 * excess, edge, size};
}

/// Marks the base cells that the box of some triangle meets: the only ones that the surface may cut.
void mark_touched(const Surface& surface, const Lattice& lattice, std::vector<std::uint8_t>& touched) {
  for (const auto& triangle : surface.triangles.rowwise()) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      corners.row(k) = surface.vertices.row(triangle[k]);
    }
    const auto cell_at = [&](const Eigen::Vector3d& x, double slack) -> Fine {
      const Eigen::Array3d index = ((x - lattice.origin) / lattice.edge).array() + slack;
      return index.floor().cast<std::int64_t>().max(0).min(lattice.size - 1);
    };
    const Fine from = cell_at(corners.colwise().minCoeff(), -1e-9);
    const Fine to = cell_at(corners.colwise().maxCoeff(), 1e-9);
    for (std::int64_t k = from.z(); k <= to.z(); ++k) {
      for (std::int64_t j = from.y(); j <= to.y(); ++j) {
        for (std::int64_t i = from.x(); i <= to.x(); ++i) {
          touched[static_cast<std::size_t>((k * lattice.size.y() + j) * lattice.size.x() + i)] = 1;
        }
      }
    }
  }
}

/// A cell, its size in finest grid lines.
struct Box {
  Fine low;
  std::int64_t edge;
  bool touched;
};

std::vector<Box> boxes_of(const Lattice& lattice, const std::vector<std::uint8_t>& touched, const SizingField& sizing) {
  std::vector<Box> boxes;
  for (std::int64_t cell = 0; cell < lattice.cells(); ++cell) {
    const Fine base(cell % lattice.size.x(), cell / lattice.size.x() % lattice.size.y(),
                    cell / (lattice.size.x() * lattice.size.y()));
    const Eigen::Vector3d middle = lattice.corner(subdivisions * base + subdivisions / 2);
    const int level = std::clamp(static_cast<int>(std::lround(-std::log2(sizing.factor(middle)))), 0, deepest_level);
    const std::int64_t parts = std::int64_t{1} << level;
    const std::int64_t edge = subdivisions / parts;
    for (std::int64_t part = 0; part < parts * parts * parts; ++part) {
      const Fine offset(part % parts, part / parts % parts, part / (parts * parts));
      boxes.push_back({subdivisions * base + edge * offset, edge, touched[static_cast<std::size_t>(cell)] != 0});
    }
  }
  return boxes;
}

/// What became of a box on one side.
struct Outcome {
  double fraction = 0, volume = 0;  // volume: of a box that the surface touches, mm³
  std::int32_t label = 0;
  std::unique_ptr<InsideOctants> octants = {};  // of a box that is cut: most are not
};

Outcome examine(const Box& box, const Lattice& lattice, const BodySide& side) {
  const Scanlines& body = side.body;
  const double edge = lattice.fine_edge() * static_cast<double>(box.edge);
  const Eigen::Vector3d low = lattice.corner(box.low);
  Outcome outcome;
  Eigen::Vector3d centroid = low.array() + 0.5 * edge;
  if (box.touched) {
    const InsidePart part = inside_part(body, low, edge);
    centroid = part.centroid;
    outcome.volume = part.volume;
    outcome.fraction = std::min(1.0, part.volume / (edge * edge * edge));
    if (outcome.fraction >= negligible_cell && outcome.fraction < whole_cell) {
      outcome.octants = std::make_unique<InsideOctants>(part.octants);
    }
  } else {
    outcome.fraction = body.inside(centroid) ? 1.0 : 0.0;
  }
  if (outcome.fraction >= negligible_cell) {
    outcome.label = side.tissue.tissue_at(centroid);
  }
  return outcome;
}

/// Numbers the corners of all cells, each place once.
void add_vertices(const std::vector<Box>& boxes, const Lattice& lattice, BackgroundCells& cells) {
  const Fine lines = subdivisions * lattice.size + 1;
  const auto key = [&](const Fine& f) { return (f.z() * lines.y() + f.y()) * lines.x() + f.x(); };
  std::vector<std::int64_t> corners;
  corners.reserve(8 * boxes.size());
  for (const Box& box : boxes) {
    for (const auto& corner : vtk_corner) {
      corners.push_back(key(box.low + box.edge * Fine(corner[0], corner[1], corner[2])));
    }
  }
  std::vector<std::int64_t> places = corners;
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  cells.vertices.resize(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Fine fine(places[i] % lines.x(), places[i] / lines.x() % lines.y(), places[i] / (lines.x() * lines.y()));
    cells.vertices.row(static_cast<Eigen::Index>(i)) = lattice.corner(fine).transpose();
  }
  for (const std::int64_t corner : corners) {
    const auto place = std::lower_bound(places.begin(), places.end(), corner);
    cells.connectivity.push_back(static_cast<std::int32_t>(place - places.begin()));
  }
}

}  // namespace

CellGrid cut_hexahedra(std::span<const Surface> surfaces, std::span<const BodySide> sides, const SizingField& sizing,
                       double edge) {
  const Lattice lattice = make_lattice(surfaces.front(), edge);
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(lattice.cells()), 0);
  for (const Surface& surface : surfaces) {
    mark_touched(surface, lattice, touched);
  }
  const std::vector<Box> boxes = boxes_of(lattice, touched, sizing);
  std::vector<Outcome> outcomes(boxes.size() * sides.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    outcomes[i] = examine(boxes[i / sides.size()], lattice, sides[i % sides.size()]);
  }
  CellGrid grid;
  grid.cells.kind = CellKind::hexahedron;
  std::vector<Box> kept;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    if (outcome.fraction < negligible_cell) {
      grid.dropped_cells += outcome.fraction > 0 ? 1 : 0;
      grid.dropped_volume += outcome.volume;
      continue;
    }
    const bool cut = outcome.octants != nullptr;
    kept.push_back(boxes[i / sides.size()]);
    grid.cells.inside_fraction.push_back(cut ? outcome.fraction : 1.0);
    grid.cells.label.push_back(outcome.label);
    grid.cells.cut_index.push_back(cut ? static_cast<std::int32_t>(grid.cells.cut_parts.size()) : -1);
    if (cut) {
      grid.cells.cut_parts.push_back(*outcome.octants);
    }
  }
  add_vertices(kept, lattice, grid.cells);
  return grid;
}

}  // namespace brainshift::discretise
