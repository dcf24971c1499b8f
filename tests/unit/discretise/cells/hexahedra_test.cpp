// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

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
using test::with_nodes;
const Eigen::Vector3d centre(30, -210, 55);

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

TEST(Hexahedra, AreInTwoWhereAWallPartsThem) {
  const Surface surface = ball(40, centre, 5), wall = test::sphere(centre + Eigen::Vector3d(0, 0, 30), 22, 4);
  const LabelMap labels = test::ball_labels(centre + Eigen::Vector3d(0, 0, 30), 22, 75);  // 3 within
  DiscretiseOptions options;
  options.nodes = 2000;
  options.brain_labels = {1, 3};
  options.resected = ResectedTissue{wall, {3}};
  const Discretisation result = discretise(surface, &labels, options);
  const Inside in_ball(surface), in_wall(wall);
  const BackgroundCells& cells = result.cells;
  double within = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells.cut_index[cell] < 0) {
      continue;
    }
    const InsideOctants& part = cells.cut_parts[static_cast<std::size_t>(cells.cut_index[cell])];
    for (int octant = 0; octant < 8; ++octant) {
      if (part.volume[octant] > 0) {
        EXPECT_TRUE(in_ball(part.centroid[octant]));
        EXPECT_EQ(in_wall(part.centroid[octant]), cells.label[cell] == 3);
      }
    }
  }
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const double edge =
        cells.vertices(cells.connectivity[8 * cell + 1], 0) - cells.vertices(cells.connectivity[8 * cell], 0);
    within += cells.label[cell] == 3 ? cells.inside_fraction[cell] * edge * edge * edge : 0;
  }
  EXPECT_NEAR(result.measures.cells_inside_volume, volume(surface), 2e-3 * volume(surface));
  // Of two balls at a distance d: π (R + r − d)² (d² + 2d(R + r) − 3(R − r)²) / 12d.
  const double d = 30, sum = 40 + 22, difference = 40 - 22;
  const double lens =
      std::numbers::pi * std::pow(sum - d, 2) * (d * d + 2 * d * sum - 3 * difference * difference) / (12 * d);
  EXPECT_NEAR(within, lens, 0.005 * lens);
  std::size_t on_wall = 0;
  for (std::size_t a = 0; a < result.cloud.size(); ++a) {
    const Eigen::Vector3d x = result.cloud.positions.row(static_cast<Eigen::Index>(a));
    const double off = (x - centre - Eigen::Vector3d(0, 0, 30)).norm() - 22;
    on_wall += result.cloud.on_surface[a] == 0 && std::abs(off) < 0.1 && !in_wall(x.data()) ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(on_wall), static_cast<double>(result.measures.wall_nodes),
              0.03 * static_cast<double>(on_wall));
  EXPECT_GT(on_wall, 100U);
}

}  // namespace brainshift::discretise::hexahedra_test
