// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "segmentation/geometry/loose_vertices.hpp"
#include "segmentation/geometry/quantile.hpp"
#include "segmentation/geometry/surface_tree.hpp"
#include "segmentation/options/values.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {
namespace {

constexpr double farthest_median = 20.0;          ///< mm
constexpr double widest = 16.0, narrowest = 1.0;  ///< smoothing lengths, mm
constexpr int rounds = 3;                         ///< a smoothing length
constexpr double drag = 3e-2;                     ///< on movement along the surface, a share of the pull towards it

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

void check(const Surface& surface, const char* name) {
  if (surface.triangles.rows() == 0 || !surface.vertices.allFinite() || surface.triangles.minCoeff() < 0 ||
      surface.triangles.maxCoeff() >= surface.vertices.rows()) {
    throw std::invalid_argument("load: the surface " + std::string(name) +
                                " has no triangle, a vertex that is not finite, or a triangle of a missing vertex");
  }
}

/// A third of the area of a vertex's triangles, mm².
Eigen::VectorXd vertex_areas(const Surface& surface) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(surface.vertices.rows());
  for (const auto& corner : surface.triangles.rowwise()) {
    const Eigen::RowVector3d a = surface.vertices.row(corner[0]);
    const double area = (surface.vertices.row(corner[1]) - a).cross(surface.vertices.row(corner[2]) - a).norm() / 2;
    for (const auto v : corner) {
      areas[v] += area / 3;
    }
  }
  return areas;
}

/// Σ over edges |u_a - u_b|² as a matrix over the displacements of all vertices, x y z after another. An edge counts
/// as much as the cotangents of equilateral triangles have it, 1/(2√3) for each of its triangles.
Sparse roughness(const Surface& surface) {
  const double weight = 1 / (2 * std::sqrt(3.0));
  Triplets entries;
  for (const auto& corner : surface.triangles.rowwise()) {
    for (int side = 0; side < 3; ++side) {
      const int a = 3 * corner[side], b = 3 * corner[(side + 1) % 3];
      for (int axis = 0; axis < 3; ++axis) {
        entries.insert(entries.end(), {{a + axis, a + axis, weight},
                                       {b + axis, b + axis, weight},
                                       {a + axis, b + axis, -weight},
                                       {b + axis, a + axis, -weight}});
      }
    }
  }
  Sparse matrix(surface.vertices.size(), surface.vertices.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<SurfacePlace> nearest_places(const SurfaceTree& tree, const Points& positions) {
  std::vector<SurfacePlace> places(static_cast<std::size_t>(positions.rows()));
#pragma omp parallel for schedule(static)
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    places[v] = tree.nearest(positions.row(v));
  }
  return places;
}

void check_together(const Points& positions, const std::vector<SurfacePlace>& places) {
  std::vector<double> distances;
  for (std::size_t v = 0; v < places.size(); ++v) {
    distances.push_back((places[v].position.transpose() - positions.row(static_cast<Eigen::Index>(v))).norm());
  }
  if (const double usual = median(std::move(distances)); usual > farthest_median) {
    throw std::invalid_argument("load: the surfaces before and after are " + with_decimals(usual) +
                                " mm apart (median), farther than a brain shifts; are both in the same frame?");
  }
}

/// Where the nearest place is on the rim of the surface after, nothing tells how a place has moved.
void check_covered(const std::vector<SurfacePlace>& places, const Eigen::VectorXd& areas) {
  constexpr double least = 0.2;
  double covered = 0;
  for (std::size_t v = 0; v < places.size(); ++v) {
    covered += places[v].on_rim ? 0 : areas[static_cast<Eigen::Index>(v)];
  }
  if (const double share = covered / areas.sum(); !(share > least)) {
    throw std::invalid_argument("load: only " + std::to_string(std::lround(100 * share)) +
                                " % of the surface before lies over the surface after; are both of one opening, and "
                                "in the same frame?");
  }
}

/// The pull towards the planes of the nearest places: matrix and right side of the least squares.
struct Pull {
  Sparse matrix;
  Eigen::VectorXd right;
};

Pull pull_to(const std::vector<SurfacePlace>& places, const Points& positions, const Eigen::VectorXd& areas) {
  Pull pull{Sparse(positions.size(), positions.size()), Eigen::VectorXd::Zero(positions.size())};
  Triplets entries;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const auto v = static_cast<int>(n);
    const double share = places[n].on_rim ? 0 : areas[v];
    const Eigen::Vector3d& normal = places[n].normal;
    const Eigen::Matrix3d along_normal = normal * normal.transpose();
    const Eigen::Matrix3d block = share * along_normal + drag * areas[v] * (Eigen::Matrix3d::Identity() - along_normal);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        entries.emplace_back(3 * v + row, 3 * v + column, block(row, column));
      }
    }
    pull.right.segment<3>(3 * v) = share * normal * normal.dot(places[n].position - positions.row(v).transpose());
  }
  pull.matrix.setFromTriplets(entries.begin(), entries.end());
  return pull;
}

}  // namespace

CraniotomyLoad load_from_surfaces(const Surface& given_before, const Surface& after) {
  check(given_before, "before");
  check(after, "after");
  const Surface before = without_loose_vertices(given_before);
  const SurfaceTree tree(after);
  check_together(before.vertices, nearest_places(tree, before.vertices));
  const Eigen::VectorXd areas = vertex_areas(before);
  const Sparse smooth = roughness(before);

  CraniotomyLoad load{before.vertices, Points::Zero(before.vertices.rows(), 3)};
  Eigen::SimplicialLDLT<Sparse> solver;  // of one pattern, whatever the places
  solver.analyzePattern(pull_to(nearest_places(tree, load.positions), load.positions, areas).matrix + smooth);
  for (double length = widest; length >= narrowest; length /= 2) {
    for (int round = 0; round < rounds; ++round) {
      const auto places = nearest_places(tree, load.positions + load.displacement);
      const Pull pull = pull_to(places, load.positions, areas);
      solver.factorize(pull.matrix + length * length * smooth);
      const Eigen::VectorXd moved = solver.solve(pull.right);
      load.displacement = Eigen::Map<const Points>(moved.data(), load.positions.rows(), 3);
    }
  }
  if (!load.displacement.allFinite()) {
    throw std::invalid_argument("load: the surface before cannot be laid on the surface after; check both");
  }
  check_covered(nearest_places(tree, load.positions + load.displacement), areas);
  return load;
}

}  // namespace brainshift::solve
