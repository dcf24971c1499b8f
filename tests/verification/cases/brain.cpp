// SPDX-License-Identifier: GPL-3.0-or-later
//
// Figure 4 of the source: brain shift on the brain of the demo, MLS and MMLS on two kinds of cells, against finite
// elements on the same geometry, load and material.
#include <algorithm>
#include <cmath>

#include "discretise/discretise.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
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

solve::Model brain_model(const Surface& surface, const Points& at_vertex, std::size_t nodes, CellKind kind) {
  discretise::DiscretiseOptions options;
  options.nodes = nodes;
  options.cells = kind;
  const discretise::Discretisation parts = discretise::discretise(surface, nullptr, options);
  solve::Model model;
  model.cloud = parts.cloud;
  put_nodes_at_loaded_vertices(model.cloud, surface, at_vertex);
  model.cells = parts.cells;
  model.materials[1] = {3000, 0.49, 1000};
  const auto count = static_cast<Eigen::Index>(model.cloud.size());
  model.cloud.prescribed_displacement = Points::Constant(count, 3, std::nan(""));
#pragma omp parallel for schedule(dynamic, 64)
  for (Eigen::Index a = 0; a < count; ++a) {
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] != 0) {
      model.cloud.prescribed_displacement.row(a) = imposed_at(surface, at_vertex, model.cloud.positions.row(a));
    }
  }
  return model;
}

}  // namespace

Outcome brain(bool small) {
  const Surface surface = read_surface(BRAINSHIFT_REFERENCES "/brain_surface.vtp");
  const Points at_vertex = at_vertices(surface, read_rows("brain_load.csv"));
  const Reference reference = read_reference("brain", "");
  const std::size_t nodes = small ? 3000 : 19000;
  Outcome outcome;
  for (const auto& [cell_name, kind] :
       {std::pair{"hexahedra", CellKind::hexahedron}, std::pair{"tetrahedra", CellKind::tetrahedron}}) {
    const solve::Model model = brain_model(surface, at_vertex, nodes, kind);
    for (const auto& [basis_name, basis, bounded] :
         {std::tuple{"MMLS", Basis::modified_quadratic, true}, {"MLS, linear basis", Basis::linear, false}}) {
      solve::SolveOptions options;
      options.shape.basis = basis;
      options.points_per_cell = kind == CellKind::hexahedron ? 8 : 4;
      const solve::SolveResult result = solved(model, options);
      const Differences d = differences(result.solution, reference.positions, reference.displacement);
      const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
      const std::string name = std::string("brain shift, ") + std::to_string(model.cloud.size()) + " nodes, " +
                               cell_name + ", " + basis_name + ": ";
      const double wider = small ? 3 : 1;
      const auto bound = [&](double most) { return bounded ? std::optional(wider * most) : std::nullopt; };
      outcome.figures.push_back(
          {name + "mean difference", "< 0.2 mm", d.mean, "mm", bound(0.05), {}, reference.error, seconds});
      outcome.figures.push_back({name + "95 %", "", d.percentile95, "mm", bound(0.15), {}, reference.error, seconds});
      outcome.figures.push_back({name + "largest", "", d.largest, "mm", bound(0.5), {}, reference.error, seconds});
    }
  }
  return outcome;
}

}  // namespace brainshift::verification
