// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds and cells that nobody wants: graded 1 : 20, with nodes nearly in one place, nearly in one plane, and with
// slivers among the tetrahedra. Under a linear displacement of the whole surface the answer is linear, whatever they
// are.
#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "segmentation/geometry/neighbour_distance.hpp"
#include "tests/extremes/row.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/move_surface.hpp"
#include "tests/verification/clouds.hpp"

namespace brainshift::extremes::clouds_cases {

namespace {

constexpr double side = 60;

/// A stretch and a shear.
Eigen::Matrix3d imposed() {
  Eigen::Matrix3d h = Eigen::Vector3d(0.1, 0.1, -0.2).asDiagonal();
  h(0, 2) = 0.1;
  return h;
}

/// With derivatives that hold the patch test, so that nothing but the cloud can be at fault.
solve::SolveOptions exact_integration() {
  solve::SolveOptions options;
  options.consistency_defect = 1e-10;
  options.max_steps = 20000;
  return options;
}

Ending patch_test(NodeCloud cloud, BackgroundCells cells, const solve::SolveOptions& options = exact_integration()) {
  solve::Model model;
  model.cloud = std::move(cloud);
  model.conditions = test::all_free(model.cloud);
  model.cells = std::move(cells);
  model.materials[1] = {3000, 0.49, 1000};
  test::move_surface(model, imposed());
  return run(model, options);
}

Row patch_row(const std::string& what, Must must, const Ending& ending, const std::string& words = {}) {
  double off = std::nan("");
  if (const Solution& s = ending.result.solution; s.positions.rows() > 0) {
    const Points wanted = s.positions * imposed().transpose();
    off = 100 * (s.displacement - wanted).rowwise().norm().maxCoeff() / wanted.rowwise().norm().maxCoeff();
  }
  return judge(what, must, ending, {{"displacement off by", off, 0.1, "% of the largest"}},
               "linear patch test, on paper", words);
}

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
  const NodeCloud cloud =
      verification::box_cloud(Eigen::Vector3d::Constant(side), least_distance, 3,
                              [&](const Eigen::Vector3d& x) { return std::clamp((x - fine).norm() / 45, 0.05, 1.0); });
  const Ending ending = patch_test(cloud, graded_cells(cells));
  std::ostringstream name;
  const auto [finest, coarsest] = std::minmax_element(cloud.spacing.begin(), cloud.spacing.end());
  name << "spacing from " << *finest << " to " << *coarsest << " mm, " << cloud.size() << " nodes";
  return patch_row(name.str(), Must::answer, ending);
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
  }
  cloud.spacing = mean_neighbour_distance(nearest_neighbours(cloud.positions, 6), 6);
  return cloud;
}

Row twins(double apart, bool held, int n, Must must) {
  const NodeCloud cloud = with_twins(test::irregular_box(n, side), apart, held);
  const Ending ending = patch_test(cloud, test::box_cells(n - 1, side));
  std::ostringstream name;
  name << cloud.size() - static_cast<std::size_t>(n * n * n) << " twins of " << (held ? "loaded" : "inner")
       << " nodes, " << apart << " of the spacing apart";
  return patch_row(name.str(), must, ending, must == Must::refuse ? "apart" : "");
}

/// A slab of layers of n × n nodes.
Row slab(int layers, double thickness, int n, Must must) {
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
  cloud.on_surface.resize(count);
  for (std::size_t a = count - static_cast<std::size_t>(n * n); a < count; ++a) {
    cloud.on_surface[a] = 1;
  }
  cloud.spacing = mean_neighbour_distance(nearest_neighbours(cloud.positions, 6), 6);
  const BackgroundCells cells = test::box_cells({n - 1, n - 1, std::max(layers - 1, 1)}, {side, side, thickness});
  const Ending ending = patch_test(cloud, cells);
  std::ostringstream name;
  name << "slab of " << side << " × " << side << " × " << thickness << " mm, " << layers << " layers, nodes " << h
       << " mm apart";
  return patch_row(name.str(), must, ending, must == Must::refuse ? "mm" : "");
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
  const int n = small ? 6 : 9, wide = small ? 9 : 21;
  return {graded(small ? 20 : 12, small ? 10 : 14), twins(0.1, false, n, Must::answer),
          twins(0.05, false, n, Must::refuse),      twins(0.02, false, n, Must::refuse),
          twins(1e-3, false, n, Must::refuse),      twins(1e-6, false, n, Must::refuse),
          twins(0.1, true, n, Must::answer),        twins(0.05, true, n, Must::refuse),
          twins(1e-3, true, n, Must::refuse),       twins(1e-6, true, n, Must::refuse),
          slab(4, 6, wide, Must::answer),           slab(3, 0.6, wide, small ? Must::refuse : Must::answer),
          slab(3, 0.06, wide, Must::refuse)};
}

std::vector<Row> slivers(bool small) {
  const int n = small ? 5 : 7;
  const NodeCloud cloud = test::irregular_box(n, side);
  std::vector<Row> rows;
  for (const double aspect : {1e-4, 1e-8}) {
    for (const int points : {1, 4}) {
      solve::SolveOptions options = exact_integration();
      options.points_per_cell = points;
      const BackgroundCells cells = with_slivers(test::box_tetrahedra(cloud, n), aspect);
      const Ending ending = patch_test(cloud, cells, options);
      std::ostringstream name;
      name << "every sixth of " << cells.size() << " tetrahedra a sliver of aspect " << aspect << ", " << points
           << " points each";
      rows.push_back(patch_row(name.str(), Must::answer, ending));
    }
  }
  return rows;
}

}  // namespace brainshift::extremes::clouds_cases
