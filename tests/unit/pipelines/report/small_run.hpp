// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/report/run_data.hpp"

namespace brainshift::pipelines {

/// A brain that is a cube of 40 mm about the origin, as triangles of a grid on its sides.
inline Surface cube_surface() {
  constexpr int n = 8;
  Surface cube{Points(6 * (n + 1) * (n + 1), 3), Triangles(12 * n * n, 3)};
  Eigen::Index vertex = 0, triangle = 0;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, sign = side % 2 == 0 ? -1 : 1;
    const auto first = static_cast<std::int32_t>(vertex);
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        Eigen::RowVector3d place;
        place[axis] = sign * 20;
        place[(axis + 1) % 3] = -20 + 40.0 * i / n;
        place[(axis + 2) % 3] = -20 + 40.0 * j / n;
        cube.vertices.row(vertex++) = place;
      }
    }
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const std::int32_t a = first + j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
        cube.triangles.row(triangle++) << a, sign > 0 ? b : c, sign > 0 ? c : b;
        cube.triangles.row(triangle++) << a, sign > 0 ? c : d, sign > 0 ? d : c;
      }
    }
  }
  return cube;
}

/// The cube's upper side sinks by 4 mm in its middle, where it is loaded; the image gets darker towards the feet.
inline RunData small_run() {
  RunData run{.record = nlohmann::json::object(),
              .t1 = ScalarImage{},
              .warped = {},
              .forward = {},
              .brain = cube_surface(),
              .solution = Solution{},
              .history = "step,time,error_bound_mm\n0,0,1\n9,1,0.1\n"};
  ImageGeometry& grid = run.t1->geometry;
  grid.size = {30, 30, 30};
  grid.spacing = {2, 2, 2};
  grid.origin = {-29, -29, -29};
  for (std::size_t voxel = 0; voxel < grid.voxel_count(); ++voxel) {
    run.t1->voxels.push_back(static_cast<float>(voxel / 900));
  }
  run.warped = run.t1;
  Solution& solution = *run.solution;
  solution.positions = run.brain->vertices;
  solution.displacement = Points::Zero(solution.positions.rows(), 3);
  solution.reaction_force = solution.displacement;
  solution.spacing.assign(static_cast<std::size_t>(solution.positions.rows()), 5.0);
  for (Eigen::Index node = 0; node < solution.positions.rows(); ++node) {
    const Eigen::Vector3d x = solution.positions.row(node);
    if (x.z() == 20 && x.head<2>().norm() < 11) {
      solution.displacement(node, 2) = -4;
      solution.reaction_force(node, 2) = 1;
    }
  }
  return run;
}

}  // namespace brainshift::pipelines
