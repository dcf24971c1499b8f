// SPDX-License-Identifier: GPL-3.0-or-later
//
// The brain, the load and the samples of the finite-element reference for the program: makes cloud and cells with the
// reference's displacements prescribed, and evaluates a solution at the reference's samples.
//
//   brain_load cloud OUT NODES
//   brain_load at SOLUTION.vtu OUT.csv
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "discretise/discretise.hpp"
#include "tests/verification/reference.hpp"

namespace {

using namespace brainshift;
using verification::read_rows;

/// Displacements of the surface's vertices; NaN: free.
Points at_vertices(const Surface& surface) {
  Points displacement = Points::Constant(surface.vertices.rows(), 3, std::nan(""));
  for (const std::vector<double>& row : read_rows("brain_load.csv")) {
    Eigen::Index vertex = 0;
    (surface.vertices.rowwise() - Eigen::RowVector3d(row[0], row[1], row[2])).rowwise().squaredNorm().minCoeff(&vertex);
    displacement.row(vertex) << row[3], row[4], row[5];
  }
  return displacement;
}

/// What is prescribed at a place of the surface: linear on triangles whose corners all have a displacement.
Eigen::RowVector3d prescribed_at(const Surface& surface, const Points& at_vertex, const Eigen::RowVector3d& x) {
  constexpr double on_triangle = 1e-3;  // mm
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Eigen::RowVector3i corner = surface.triangles.row(t);
    const Points at = at_vertex({corner[0], corner[1], corner[2]}, Eigen::all);
    const Points place = surface.vertices({corner[0], corner[1], corner[2]}, Eigen::all);
    Eigen::Matrix<double, 3, 2> edges;
    edges << (place.row(1) - place.row(0)).transpose(), (place.row(2) - place.row(0)).transpose();
    const Eigen::Vector3d from = (x - place.row(0)).transpose();
    const Eigen::Vector2d share = (edges.transpose() * edges).ldlt().solve(edges.transpose() * from);
    if (!at.hasNaN() && share.minCoeff() > -1e-6 && share.sum() < 1 + 1e-6 &&
        (edges * share - from).norm() < on_triangle) {
      return (1 - share.sum()) * at.row(0) + share[0] * at.row(1) + share[1] * at.row(2);
    }
  }
  return Eigen::RowVector3d::Constant(std::nan(""));
}

/// Moves the nearest surface node onto each vertex with a displacement: the load's edge has tips between nodes.
void put_nodes_at_vertices(NodeCloud& cloud, const Surface& surface, const Points& at_vertex) {
  for (Eigen::Index v = 0; v < surface.vertices.rows(); ++v) {
    if (std::isnan(at_vertex(v, 0))) {
      continue;
    }
    Eigen::Index nearest = -1;
    for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
      const auto away = [&](Eigen::Index b) {
        return (cloud.positions.row(b) - surface.vertices.row(v)).squaredNorm();
      };
      if (cloud.on_surface[static_cast<std::size_t>(a)] != 0 && (nearest < 0 || away(a) < away(nearest))) {
        nearest = a;
      }
    }
    cloud.positions.row(nearest) = surface.vertices.row(v);
  }
}

void make_cloud(const std::vector<std::string>& words) {
  const Surface surface = read_surface(BRAINSHIFT_REFERENCES "/brain_surface.vtp");
  const Points at_vertex = at_vertices(surface);
  discretise::DiscretiseOptions options;
  options.nodes = std::stoul(words[2]);
  discretise::Discretisation made = discretise::discretise(surface, nullptr, options);
  NodeCloud& cloud = made.cloud;
  put_nodes_at_vertices(cloud, surface, at_vertex);
  cloud.prescribed_displacement = Points::Constant(cloud.positions.rows(), 3, std::nan(""));
#pragma omp parallel for schedule(dynamic, 64)
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (cloud.on_surface[static_cast<std::size_t>(a)] != 0) {
      cloud.prescribed_displacement.row(a) = prescribed_at(surface, at_vertex, cloud.positions.row(a));
    }
  }
  discretise::write_discretisation(words[1], made);
}

void evaluate(const std::vector<std::string>& words) {
  const Points places = verification::read_reference("brain", "").positions;
  const Points found = verification::displacement_at(read_solution(words[1]), places);
  std::ofstream csv(words[2]);
  csv << "ux,uy,uz\n" << found.format(Eigen::IOFormat(8, Eigen::DontAlignCols, ",")) << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool cloud = words.size() == 3 && words[0] == "cloud";
  if (!cloud && !(words.size() == 3 && words[0] == "at")) {
    std::fprintf(stderr, "usage: brain_load cloud OUT NODES | at SOLUTION.vtu OUT.csv\n");
    return 2;
  }
  try {
    cloud ? make_cloud(words) : evaluate(words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "brain_load: %s\n", error.what());
    return 1;
  }
  return 0;
}
