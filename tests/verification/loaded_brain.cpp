// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/verification/loaded_brain.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "discretise/discretise.hpp"
#include "segmentation/files/surface_file.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification {

namespace {

/// The displacements of surface vertices, by vertex of the surface; NaN: free.
Points at_vertices(const Surface& surface, const std::vector<std::vector<double>>& load) {
  Points displacement = Points::Constant(surface.vertices.rows(), 3, std::nan(""));
  for (const std::vector<double>& row : load) {
    Eigen::Index vertex = 0;
    (surface.vertices.rowwise() - Eigen::RowVector3d(row[0], row[1], row[2])).rowwise().squaredNorm().minCoeff(&vertex);
    displacement.row(vertex) << row[3], row[4], row[5];
  }
  return displacement;
}

/// The displacement imposed at a place on the surface: linear over a triangle whose corners all have one, else none.
Eigen::RowVector3d imposed_at(const Surface& surface, const Points& at_vertex, const Eigen::RowVector3d& x) {
  constexpr double on_triangle = 1e-3;  // mm
  Eigen::RowVector3d imposed = Eigen::RowVector3d::Constant(std::nan(""));
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Eigen::RowVector3i corner = surface.triangles.row(t);
    const Eigen::Vector3d a = surface.vertices.row(corner[0]);
    Eigen::Matrix<double, 3, 2> edges;
    edges << surface.vertices.row(corner[1]).transpose() - a, surface.vertices.row(corner[2]).transpose() - a;
    const Eigen::Vector3d from = x.transpose() - a;
    const Eigen::Vector2d share = (edges.transpose() * edges).ldlt().solve(edges.transpose() * from);
    const bool inside = share.minCoeff() > -1e-6 && share.sum() < 1 + 1e-6;
    if (inside && (edges * share - from).norm() < on_triangle) {
      const Eigen::RowVector3d here = (1 - share.sum()) * at_vertex.row(corner[0]) +
                                      share[0] * at_vertex.row(corner[1]) + share[1] * at_vertex.row(corner[2]);
      imposed = std::isnan(here[0]) ? imposed : here;
    }
  }
  return imposed;
}

/// Moves the nearest surface node onto each vertex that has a displacement, so that the load ends where it ends in the
/// reference: its edge has tips that lie between nodes.
void put_nodes_at_loaded_vertices(NodeCloud& cloud, const Surface& surface, const Points& at_vertex) {
  std::vector<Eigen::Index> outer;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (cloud.on_surface[static_cast<std::size_t>(a)] != 0) {
      outer.push_back(a);
    }
  }
  const Points places = cloud.positions(outer, Eigen::all);
  for (Eigen::Index v = 0; v < surface.vertices.rows(); ++v) {
    if (!std::isnan(at_vertex(v, 0))) {
      Eigen::Index nearest = 0;
      (places.rowwise() - surface.vertices.row(v)).rowwise().squaredNorm().minCoeff(&nearest);
      cloud.positions.row(outer[static_cast<std::size_t>(nearest)]) = surface.vertices.row(v);
    }
  }
}

/// The vertices that the load moves.
Points moved(const Surface& surface, const Points& at_vertex) {
  std::vector<Eigen::Index> vertices;
  for (Eigen::Index v = 0; v < at_vertex.rows(); ++v) {
    if (at_vertex.row(v).norm() > 0) {
      vertices.push_back(v);
    }
  }
  return surface.vertices(vertices, Eigen::all);
}

}  // namespace

solve::Model loaded_brain(std::size_t nodes, CellKind kind, bool refined) {
  const Surface surface = read_surface(BRAINSHIFT_REFERENCES "/brain_surface.vtp");
  const Points at_vertex = at_vertices(surface, read_rows("brain_load.csv"));
  discretise::DiscretiseOptions options;
  options.nodes = nodes;
  options.cells = kind;
  if (refined) {
    options.craniotomy = discretise::Refinement{moved(surface, at_vertex), 10, 0.5};
  }
  discretise::Discretisation made = discretise::discretise(surface, nullptr, options);
  solve::Model model;
  model.cloud = std::move(made.cloud);
  model.cells = std::move(made.cells);
  const NodeCloud& cloud = model.cloud;
  put_nodes_at_loaded_vertices(model.cloud, surface, at_vertex);
  model.conditions = test::all_free(cloud);
  const auto count = static_cast<Eigen::Index>(cloud.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (Eigen::Index a = 0; a < count; ++a) {
    if (cloud.on_surface[static_cast<std::size_t>(a)] != 0) {
      model.conditions.displacement.row(a) = imposed_at(surface, at_vertex, cloud.positions.row(a));
    }
  }
  return model;
}

}  // namespace brainshift::verification
