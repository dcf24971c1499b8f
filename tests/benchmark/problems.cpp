// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/problems.hpp"

#include "discretise/discretise.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/solve/all_free.hpp"

namespace brainshift::bench {

Surface ellipsoid_surface(double larger) {
  Surface surface = test::ball(1, Eigen::Vector3d::Zero(), 5);
  surface.vertices *= Eigen::Vector3d(80 + larger, 65 + larger, 60 + larger).asDiagonal();
  return surface;
}

Problem ellipsoid(std::size_t nodes, double cells_per_node, const std::optional<Surface>& wall) {
  discretise::DiscretiseOptions options;
  options.nodes = nodes;
  options.cells_per_node = cells_per_node;
  if (wall) {
    options.resected = discretise::ResectedTissue{*wall, {2}};
  }
  auto [cloud, cells, measures] = discretise::discretise(ellipsoid_surface(0), nullptr, options);
  Problem problem;
  problem.model.cloud = std::move(cloud);
  problem.model.conditions = test::all_free(problem.model.cloud);
  problem.model.cells = std::move(cells);
  problem.model.materials[1] = {3000, 0.49, 1000};
  const NodeCloud& made = problem.model.cloud;
  for (Eigen::Index a = 0; a < made.positions.rows(); ++a) {
    const double r = made.positions.row(a).head<2>().norm() / 28;
    if (made.on_surface[static_cast<std::size_t>(a)] != 0 && made.positions(a, 2) > 0 && r < 1) {
      problem.model.conditions.displacement.row(a) << 0, 0, -4 * (1 - r * r);
    }
  }
  return problem;
}

Problem problem_of_run(const std::filesystem::path& scene, const std::filesystem::path& run) {
  pipelines::SolveInput input = pipelines::read_input(solve_job(pipelines::parse_scene(scene), run));
  return {std::move(input.model), input.options};
}

void as_published(solve::SolveOptions& options) {
  options.shape.basis = Basis::linear;
  options.shape.dilatation = 1.9;
  options.points_per_cell = 1;
}

double bytes_read(const solve::PointBlocks& points) {
  return bytes(points.blocks) + bytes(points.patches) + bytes(points.volume) + bytes(points.mode) +
         bytes(points.pair_begin) + bytes(points.support) + bytes(points.pair_slot) + bytes(points.pair_derivative) +
         bytes(points.pair_single) + bytes(points.slot_node) + bytes(points.node_begin) + bytes(points.node_slot) +
         static_cast<double>(4 * sizeof(double) * points.nodes());
}

}  // namespace brainshift::bench
