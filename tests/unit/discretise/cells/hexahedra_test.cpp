// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "discretise/discretise.hpp"
#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/discretise/inside.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::hexahedra_test {

using test::ball;
using test::box;
using test::bumpy_brain;
using test::Inside;
const Eigen::Vector3d centre(30, -210, 55);

Discretisation with_nodes(const Surface& surface, std::size_t nodes, CellKind kind) {
  DiscretiseOptions options;
  options.nodes = nodes;
  options.cells = kind;
  return discretise(surface, nullptr, options);
}

TEST(Hexahedra, HoldTheVolumeOfABallWhateverTheirSize) {
  const Surface surface = ball(40, centre, 6);
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(40, 3);
  for (const std::size_t nodes : {100U, 800U, 5000U}) {
    const Discretisation result = with_nodes(surface, nodes, CellKind::hexahedron);
    EXPECT_NEAR(result.measures.cells_inside_volume, exact, 1e-3 * exact) << nodes;
    EXPECT_GT(result.measures.cut_cells, 0U);
    EXPECT_LT(result.measures.cut_cells, result.measures.cells);
  }
}

TEST(Hexahedra, OfABoxHoldItsVolumeAlthoughLinesMeetItsEdges) {
  const Discretisation result = with_nodes(box({-4, 0, 8}, {12, 32, 24}), 1000, CellKind::hexahedron);
  EXPECT_NEAR(result.measures.cells_inside_volume, 16.0 * 32 * 16, 0.002 * 16 * 32 * 16);
}

TEST(Hexahedra, AreAsManyANodeAsAsked) {
  DiscretiseOptions options;
  options.nodes = 2000;
  options.cells_per_node = 3;
  const Discretisation result = discretise(bumpy_brain(), nullptr, options);
  const BackgroundCells& cells = result.cells;
  const double edge = cells.vertices(cells.connectivity[1], 0) - cells.vertices(cells.connectivity[0], 0);
  const double per_node = result.measures.surface_volume / std::pow(edge, 3) / static_cast<double>(result.cloud.size());
  EXPECT_NEAR(per_node, 3.0, 0.03);
}

TEST(Hexahedra, HaveOctantsThatAddUpWithCentroidsInsideTheBody) {
  const Surface surface = bumpy_brain();
  const Discretisation result = with_nodes(surface, 1500, CellKind::hexahedron);
  const BackgroundCells& cells = result.cells;
  const Inside inside(surface);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells.cut_index[cell] < 0) {
      EXPECT_EQ(cells.inside_fraction[cell], 1.0);
      continue;
    }
    const Eigen::RowVector3d low = cells.vertices.row(cells.connectivity[8 * cell]);
    const Eigen::RowVector3d high = cells.vertices.row(cells.connectivity[8 * cell + 6]);
    const InsideOctants& part = cells.cut_parts[static_cast<std::size_t>(cells.cut_index[cell])];
    double total = 0;
    for (int octant = 0; octant < 8; ++octant) {
      total += part.volume[octant];
      if (part.volume[octant] > 0) {
        EXPECT_TRUE(inside(part.centroid[octant]));
        for (int axis = 0; axis < 3; ++axis) {
          const double place = (part.centroid[octant][axis] - low[axis]) / (high[axis] - low[axis]);
          const int half = octant >> axis & 1;
          EXPECT_GE(place, 0.5 * half - 1e-9);
          EXPECT_LE(place, 0.5 * half + 0.5 + 1e-9);
        }
      }
    }
    EXPECT_NEAR(total, cells.inside_fraction[cell] * (high - low).prod(), 1e-9 * total);
  }
}

TEST(Hexahedra, HaveTheCentroidOfAHalfBallAtThreeEighthsOfItsRadius) {
  // First moment of the ball's upper half from octants and whole cells against the analytic one, pi R^4 / 4.
  const Surface surface = ball(40, centre, 6);
  const BackgroundCells cells = with_nodes(surface, 2000, CellKind::hexahedron).cells;
  double moment = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const Eigen::RowVector3d low = cells.vertices.row(cells.connectivity[8 * cell]);
    const Eigen::RowVector3d edge = cells.vertices.row(cells.connectivity[8 * cell + 6]) - low;
    for (int octant = 0; octant < 8; ++octant) {
      double volume = edge.prod() / 8;
      double z = low[2] + edge[2] * (octant >> 2 != 0 ? 0.75 : 0.25);
      if (cells.cut_index[cell] >= 0) {
        const InsideOctants& part = cells.cut_parts[static_cast<std::size_t>(cells.cut_index[cell])];
        volume = part.volume[octant];
        z = part.centroid[octant][2];
      }
      moment += volume > 0 ? volume * std::max(0.0, z - centre.z()) : 0;
    }
  }
  const double exact = std::numbers::pi * std::pow(40, 4) / 4;
  EXPECT_NEAR(moment, exact, 2e-3 * exact);
}

}  // namespace brainshift::discretise::hexahedra_test
