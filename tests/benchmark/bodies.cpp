// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/bodies.hpp"

#include <cmath>

#include "discretise/discretise.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "tests/unit/discretise/bodies.hpp"

namespace brainshift::bench {

Surface ellipsoid_surface(double larger) {
  Surface surface = test::ball(1, Eigen::Vector3d::Zero(), 5);
  surface.vertices *= Eigen::Vector3d(80 + larger, 65 + larger, 60 + larger).asDiagonal();
  return surface;
}

Body ellipsoid(std::size_t nodes, double cells_per_node) {
  discretise::DiscretiseOptions options;
  options.nodes = nodes;
  options.cells_per_node = cells_per_node;
  auto [cloud, cells, measures] = discretise::discretise(ellipsoid_surface(0), nullptr, options);
  Body body;
  body.model.cloud = std::move(cloud);
  body.model.cells = std::move(cells);
  body.model.materials[1] = {3000, 0.49, 1000};
  NodeCloud& made = body.model.cloud;
  made.prescribed_displacement = Points::Constant(made.positions.rows(), 3, std::nan(""));
  for (Eigen::Index a = 0; a < made.positions.rows(); ++a) {
    const double r = made.positions.row(a).head<2>().norm() / 28;
    if (made.on_surface[static_cast<std::size_t>(a)] != 0 && made.positions(a, 2) > 0 && r < 1) {
      made.prescribed_displacement.row(a) << 0, 0, -4 * (1 - r * r);
    }
  }
  return body;
}

Body body_of_run(const std::filesystem::path& scene, const std::filesystem::path& run) {
  pipelines::SolveInput input = pipelines::read_input(solve_job(pipelines::parse_scene(scene), run));
  return {std::move(input.model), input.options};
}

void as_published(solve::SolveOptions& options) {
  options.shape.basis = Basis::linear;
  options.shape.dilatation = 1.9;
  options.points_per_cell = 1;
}

double bytes_read(const solve::PointBlocks& points) {
  return static_cast<double>(points.shape_bytes() + solve::bytes(points.mode) + 4 * sizeof(double) * points.nodes());
}

}  // namespace brainshift::bench
