// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/span_cavity.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <vector>

#include "register/field/field_sampler.hpp"

namespace brainshift::registration {

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Calls visit(neighbour, weight) for a voxel's up to six neighbours in the image.
template <class Visit>
void visit_neighbours(const ImageGeometry& g, std::size_t voxel, const Visit& visit) {
  const std::array<std::size_t, 3> stride = {1, g.offset(0, 1, 0), g.offset(0, 0, 1)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto size = static_cast<std::size_t>(g.size[static_cast<Eigen::Index>(axis)]);
    const std::size_t place = voxel / stride[axis] % size;
    const double h = g.spacing[static_cast<Eigen::Index>(axis)], weight = 1 / (h * h);
    if (place > 0) {
      visit(voxel - stride[axis], weight);
    }
    if (place + 1 < size) {
      visit(voxel + stride[axis], weight);
    }
  }
}

}  // namespace

void span_cavity(std::span<const std::size_t> hollow, const std::function<bool(std::size_t voxel)>& moves,
                 VectorImage& field) {
  const auto count = static_cast<Eigen::Index>(hollow.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  for (Eigen::Index row = 0; row < count; ++row) {
    double diagonal = 0;
    visit_neighbours(field.geometry, hollow[static_cast<std::size_t>(row)], [&](std::size_t voxel, double weight) {
      const auto found = std::ranges::lower_bound(hollow, voxel);
      const bool is_hollow = found != hollow.end() && *found == voxel;
      if (is_hollow) {
        entries.emplace_back(static_cast<int>(row), static_cast<int>(found - hollow.begin()), -weight);
      } else if (moves(voxel)) {
        const auto& u = field.voxels[voxel];
        right.row(row) += weight * Eigen::RowVector3d(u[0], u[1], u[2]);
      }
      diagonal += is_hollow || moves(voxel) ? weight : 0;
    });
    entries.emplace_back(static_cast<int>(row), static_cast<int>(row), std::max(diagonal, 1e-300));
  }
  Matrix laplace(count, count);
  laplace.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver(laplace);
  constexpr double tolerance = 1e-4;
  solver.setTolerance(tolerance);
  const Eigen::MatrixX3d u = solver.solve(right);
  for (Eigen::Index row = 0; row < count; ++row) {
    field.voxels[hollow[static_cast<std::size_t>(row)]] = stored(u.row(row).transpose());
  }
}

}  // namespace brainshift::registration
