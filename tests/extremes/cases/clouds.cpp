// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds and cells that nobody wants: graded 1 : 20, with nodes nearly in one place, nearly in one plane, and with
// slivers among the tetrahedra. The answer is a uniform stretch, whatever they are.
#include <cmath>
#include <random>
#include <sstream>

#include "discretise/neighbours/neighbour_distance.hpp"
#include "tests/extremes/block.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/verification/clouds.hpp"

namespace brainshift::extremes {

namespace {

constexpr double side = 60;
const Block cube{Eigen::Vector3d::Constant(side), 0.8};

/// Cells whose vertices crowd about (side/2, side/2, side), as the nodes do.
BackgroundCells graded_cells(int n) {
  BackgroundCells cells = test::box_cells(n, side);
  const auto crowd = [](double share) { return std::pow(share, 2.2); };
  for (Eigen::Index v = 0; v < cells.vertices.rows(); ++v) {
    for (int axis = 0; axis < 2; ++axis) {
      const double off = 2 * cells.vertices(v, axis) / side - 1;
      cells.vertices(v, axis) = side / 2 * (1 + std::copysign(crowd(std::abs(off)), off));
    }
    cells.vertices(v, 2) = side * (1 - crowd(1 - cells.vertices(v, 2) / side));
  }
  return cells;
}

Row graded(double least_distance, int cells) {
  const Eigen::Vector3d fine(side / 2, side / 2, side);
  const NodeCloud cloud = verification::box_cloud(cube.size, least_distance, 3, [&](const Eigen::Vector3d& x) {
    return std::clamp((x - fine).norm() / 45, 0.05, 1.0);
  });
  const Ending ending = run(cube.model(cloud, graded_cells(cells)), {});
  std::ostringstream name;
  const auto [finest, coarsest] = std::minmax_element(cloud.spacing.begin(), cloud.spacing.end());
  name << "spacing from " << *finest << " to " << *coarsest << " mm, " << cloud.size() << " nodes";
  return judge(name.str(), Must::answer, ending, cube.errors(ending.result, 2, 2), on_paper);
}

/// Every seventh node that is inside (or held) gets a twin this share of its spacing away, along the plane of z.
NodeCloud with_twins(NodeCloud cloud, double apart, bool held) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> turn(0, 6.28);
  std::vector<Eigen::RowVector3d> twins;
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    const Eigen::RowVector3d x = cloud.positions.row(static_cast<Eigen::Index>(a));
    const bool inside = cloud.on_surface[a] == 0;
    const bool on_top = x[2] == side && x.head<2>().minCoeff() > 0 && x.head<2>().maxCoeff() < side;
    if ((held ? on_top : inside) && random() % 7 == 0) {
      const double angle = turn(random);
      twins.emplace_back(x + apart * cloud.spacing[a] * Eigen::RowVector3d(std::cos(angle), std::sin(angle), 0));
    }
  }
  const Eigen::Index n = cloud.positions.rows(), more = static_cast<Eigen::Index>(twins.size());
  cloud.positions.conservativeResize(n + more, 3);
  for (Eigen::Index i = 0; i < more; ++i) {
    cloud.positions.row(n + i) = twins[static_cast<std::size_t>(i)];
    cloud.on_surface.push_back(held ? 1 : 0);
    cloud.label.push_back(1);
  }
  cloud.prescribed_displacement = Points::Constant(n + more, 3, std::nan(""));
  cloud.spacing = mean_neighbour_distance(nearest_neighbours(cloud.positions, 6), 6);
  return cloud;
}

Row twins(double apart, bool held, int n, Must must) {
  const NodeCloud cloud = with_twins(test::irregular_box(n, side), apart, held);
  const Ending ending = run(cube.model(cloud, test::box_cells(n - 1, side)), {});
  std::ostringstream name;
  name << cloud.size() - static_cast<std::size_t>(n * n * n) << " twins of " << (held ? "loaded" : "inner")
       << " nodes, " << apart << " of the spacing apart";
  return judge(name.str(), must, ending, cube.errors(ending.result, 1, 1), on_paper,
               must == Must::refuse ? "node" : "");
}

/// A slab of layers of n × n nodes.
Row slab(int layers, double thickness, int n, Must must) {
  const Block flat{{side, side, thickness}, 0.9};
  NodeCloud cloud = test::irregular_box(n, side);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index a = 0; a < n * n * layers; ++a) {
    kept.push_back(a);
  }
  Points positions = cloud.positions(kept, Eigen::all);
  const double h = side / (n - 1);
  for (Eigen::Index a = 0; a < positions.rows(); ++a) {
    const auto layer = static_cast<double>(a / (n * n));
    const double jitter = layer > 0 && layer < layers - 1 ? positions(a, 2) / h - layer : 0;
    positions(a, 2) = thickness * (layer + jitter) / (layers - 1);
  }
  cloud.positions = positions;
  const auto count = static_cast<std::size_t>(positions.rows());
  cloud.on_surface.assign(count, 1);
  cloud.label.assign(count, 1);
  cloud.prescribed_displacement = Points::Constant(positions.rows(), 3, std::nan(""));
  cloud.spacing = mean_neighbour_distance(nearest_neighbours(cloud.positions, 6), 6);
  const BackgroundCells cells = test::box_cells({n - 1, n - 1, std::max(layers - 1, 1)}, flat.size);
  const Ending ending = run(flat.model(cloud, cells), {});
  std::ostringstream name;
  name << "slab of " << side << " × " << side << " × " << thickness << " mm, " << layers << " layers, nodes " << h
       << " mm apart";
  return judge(name.str(), must, ending, flat.errors(ending.result, 2, 2), on_paper,
               must == Must::refuse ? "in one plane" : "");
}

/// Splits every third tetrahedron in four by a vertex so near to one of its faces that the one there is a sliver.
BackgroundCells with_slivers(const BackgroundCells& given, double aspect) {
  BackgroundCells cells = given;
  cells.connectivity.clear();
  std::vector<Eigen::RowVector3d> added;
  for (std::size_t c = 0; c < given.size(); ++c) {
    const std::int32_t* corner = &given.connectivity[4 * c];
    const std::vector<std::int32_t> whole(corner, corner + 4);
    if (c % 3 != 0) {
      cells.connectivity.insert(cells.connectivity.end(), whole.begin(), whole.end());
      continue;
    }
    const Eigen::RowVector3d face =
        (given.vertices.row(corner[0]) + given.vertices.row(corner[1]) + given.vertices.row(corner[2])) / 3;
    added.emplace_back(face + aspect * (given.vertices.row(corner[3]) - face));
    const auto middle = static_cast<std::int32_t>(given.vertices.rows() + static_cast<Eigen::Index>(added.size()) - 1);
    for (std::size_t replaced = 0; replaced < 4; ++replaced) {
      std::vector<std::int32_t> part = whole;
      part[replaced] = middle;
      cells.connectivity.insert(cells.connectivity.end(), part.begin(), part.end());
    }
  }
  cells.vertices.conservativeResize(given.vertices.rows() + static_cast<Eigen::Index>(added.size()), 3);
  for (std::size_t i = 0; i < added.size(); ++i) {
    cells.vertices.row(given.vertices.rows() + static_cast<Eigen::Index>(i)) = added[i];
  }
  cells.inside_fraction.assign(cells.connectivity.size() / 4, 1.0);
  cells.label.assign(cells.inside_fraction.size(), 1);
  return cells;
}

}  // namespace

std::vector<Row> clouds(bool small) {
  const int n = small ? 5 : 7;
  return {graded(small ? 20 : 12, small ? 8 : 12),    twins(1e-3, false, n, Must::answer),
          twins(1e-6, false, n, Must::answer),        twins(1e-3, true, n, Must::answer),
          twins(1e-6, true, n, Must::refuse),         slab(4, 6, small ? 9 : 21, Must::answer),
          slab(3, 0.6, small ? 9 : 21, Must::answer), slab(2, 3, small ? 9 : 21, Must::refuse)};
}

std::vector<Row> slivers(bool small) {
  const int n = small ? 5 : 7;
  const NodeCloud cloud = test::irregular_box(n, side);
  std::vector<Row> rows;
  for (const double aspect : {1e-4, 1e-8}) {
    for (const int points : {1, 4}) {
      solve::SolveOptions options;
      options.points_per_cell = points;
      const BackgroundCells cells = with_slivers(test::box_tetrahedra(cloud, n), aspect);
      const Ending ending = run(cube.model(cloud, cells), options);
      std::ostringstream name;
      name << "every sixth of " << cells.size() << " tetrahedra a sliver of aspect " << aspect << ", " << points
           << " points each";
      rows.push_back(judge(name.str(), Must::answer, ending, cube.errors(ending.result, 1, 1), on_paper));
    }
  }
  return rows;
}

}  // namespace brainshift::extremes
