// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <stdexcept>

#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

namespace {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

RowMatrix collocation_matrix(const ShapeFunctions& shape, const Points& positions) {
  const ShapeRows rows = shape.evaluate(positions, false);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(rows.node.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (auto k = static_cast<std::size_t>(rows.begin[i]); k < static_cast<std::size_t>(rows.begin[i + 1]); ++k) {
      entries.emplace_back(static_cast<int>(i), rows.node[k], rows.value[k]);
    }
  }
  RowMatrix v(positions.rows(), positions.rows());
  v.setFromTriplets(entries.begin(), entries.end());
  return v;
}

}  // namespace

Points parameters_from_displacement(const ShapeFunctions& shape, const Points& positions, const Points& displacement) {
  const RowMatrix v = collocation_matrix(shape, positions);
  Eigen::BiCGSTAB<RowMatrix> solver;  // the diagonal is preconditioner enough: twenty iterations
  solver.setTolerance(1e-12);
  solver.setMaxIterations(1000);
  solver.compute(v);
  Points parameters(positions.rows(), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd u = displacement.col(axis);
    parameters.col(axis) = solver.solveWithGuess(u, u);
  }
  const double largest = displacement.cwiseAbs().maxCoeff();
  const double error = (v * parameters - displacement).cwiseAbs().maxCoeff();
  if (!(error <= 1e-9 * largest)) {
    throw std::runtime_error("the shape functions' parameters could not be found from the displacement: " +
                             std::to_string(error) + " mm is left at a node; the cloud has nodes too close together");
  }
  return parameters;
}

}  // namespace brainshift::solve
