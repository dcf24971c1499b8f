// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/IterativeLinearSolvers>
#include <stdexcept>

#include "solve/shape/shape_matrix.hpp"

namespace brainshift::solve {

namespace {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

}  // namespace

Points parameters_from_displacement(const ShapeFunctions& shape, const Points& positions, const Points& displacement) {
  return parameters_from_displacement(shape_matrix(shape.evaluate(positions, false), positions.rows()), displacement);
}

Points parameters_from_displacement(const RowMatrix& v, const Points& displacement) {
  Eigen::BiCGSTAB<RowMatrix> solver;  // the diagonal is preconditioner enough: twenty iterations
  solver.setTolerance(1e-12);
  solver.setMaxIterations(1000);
  solver.compute(v);
  Points parameters(displacement.rows(), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd u = displacement.col(axis);
    parameters.col(axis) = solver.solveWithGuess(u, u);
  }
  const double largest = displacement.cwiseAbs().maxCoeff();
  const double error = (v * parameters - displacement).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (!(error <= 1e-9 * largest)) {
    throw std::runtime_error(displacement.allFinite()
                                 ? "no field can be laid through the displacements at the nodes: two of them lie too "
                                   "close together, or in one place"
                                 : "no field can be laid through the displacements at the nodes: one is not finite");
  }
  return parameters;
}

}  // namespace brainshift::solve
