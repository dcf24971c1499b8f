// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/measured_covariance.hpp"

#include <iterator>

#include "solve/measured/inner_rows.hpp"
#include "solve/measured/weight.hpp"
#include "solve/shape/nodal_displacement.hpp"

namespace brainshift::solve {

namespace {

/// Each node by itself: the response to forces on its parameters.
void append_nodes(std::size_t nodes, ShapeRows& rows) {
  constexpr double one = 1;
  for (std::size_t a = 0; a < nodes; ++a) {
    const auto node = static_cast<std::int32_t>(a);
    rows.append({std::span(&node, 1), std::span(&one, 1), {}});
  }
}

/// Φ C Φᵀ of each row, with C the joint covariance of the parameters.
Eigen::MatrixXd covariance_of(const ShapeRows& rows, const Eigen::MatrixXd& joint) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(rows.size()), 6);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ShapeRow row = rows[i];
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t a = 0; a < row.size(); ++a) {
      for (std::size_t b = 0; b < row.size(); ++b) {
        sum += row.value[a] * row.value[b] * joint.block<3, 3>(3 * row.node[a], 3 * row.node[b]);
      }
    }
    result.row(static_cast<Eigen::Index>(i)) = six_entries(sum);
  }
  return result;
}

/// The displacement of an answer as rows of the thinned body see it. displacement: at the nodes of the whole cloud.
Points answered_at(const ShapeRows& rows, const ThinnedBody& thinned, const ShapeFunctions& shape,
                   const Points& displacement) {
  return values_of(
      rows, parameters_from_displacement(shape, thinned.stiff.cloud.positions, displacement(thinned.node, Eigen::all)));
}

/// Of each place, as_said().
void say(const Points& linear, const Points& answered, Eigen::MatrixXd& covariance) {
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    covariance.row(i) = as_said(covariance.row(i), linear.row(i), answered.row(i));
  }
}

}  // namespace

void add_posterior(const MeasuredPoints& measured, const Response& response, MeasuredFit& fit) {
  const Posterior there(response, measured.displacement, measured.sigma, fit);
  fit.linear = there.mean();
  fit.covariance.resize(fit.linear.rows(), 6);
  for (Eigen::Index a = 0; a < fit.linear.rows(); ++a) {
    fit.covariance.row(a) = six_entries(there.covariance(a, 1));
  }
}

void say_by_answer(const ThinnedBody& thinned, const Points& asked, const Points& displacement, MeasuredFit& fit) {
  if (asked.rows() == 0) {
    return;
  }
  const ShapeFunctions shape = thinned.shape();
  const ShapeRows rows = inner_rows(shape, within_sight(asked, thinned.stiff.cloud));
  say(fit.linear, answered_at(rows, thinned, shape, displacement), fit.covariance);
}

Eigen::MatrixXd measured_covariance(const Model& model, const SolveOptions& options, const MeasuredFit& fit,
                                    const Points& displacement) {
  const ThinnedBody thinned = thinned_body(model, options.shape);
  const MeasuredPoints measured(thinned, model.conditions);
  ShapeRows rows = inner_rows(measured.shape, measured.positions);
  append_nodes(thinned.node.size(), rows);
  const Points places = stacked(measured.positions, thinned.stiff.cloud.positions);
  const Response response = measured.response_and_motion(rows, places);
  const Posterior of_nodes(response, measured.displacement, measured.sigma, fit);
  const ShapeRows at_all = inner_rows(measured.shape, model.cloud.positions);
  Eigen::MatrixXd covariance = covariance_of(at_all, of_nodes.covariance(0, std::ssize(thinned.node)));
  say(values_of(at_all, of_nodes.mean()), answered_at(at_all, thinned, measured.shape, displacement), covariance);
  for (Eigen::Index a = 0; a < covariance.rows(); ++a) {
    if (model.conditions.is_held(a) && !is_measured(model.conditions, a)) {
      covariance.row(a).setZero();  // a ball about it reaches past the body
    }
  }
  return covariance;
}

}  // namespace brainshift::solve
