// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// What the measured points of a model say of the weight, the noise and a rigid motion, by a linear body of some
/// hundred of the nodes: choose_weight(). Throws as solve() does.
MeasuredFit fit_measured(const Model& model, const SolveOptions& options);

/// What noise and prior leave open of the displacement at each node of the model's cloud, (n × 6) mm²: xx, yy, zz, xy,
/// yz, zx of its covariance, with the weight and the noise_factor of the fit; of the linear body of some hundred of the
/// nodes, whose shape functions carry it to the others, and, as at landmarks, of the mean over a ball of seen_radius;
/// 0 at nodes that are held. Throws as solve() does.
Eigen::MatrixXd measured_covariance(const Model& model, const SolveOptions& options, const MeasuredFit& fit);

/// A measured point that contradicts the others.
struct Outlier {
  Eigen::Vector3d position;      ///< undeformed: of the node that stands for it, or its own inside the body, mm
  Eigen::Vector3d displacement;  ///< as measured, mm
  double deviations;             ///< surprise(): how many standard deviations it is from what the others say
};

/// Points that are more than five standard deviations off, and five times farther than is usual of this load: where all
/// are far off, σ is too small, and no point is to blame. Throws as solve() does.
std::vector<Outlier> outliers(const Model& model, const SolveOptions& options, const MeasuredFit& fit);

/// solve() of a model whose conditions were measured with noise: the weight is chosen on a cloud of some hundred of the
/// nodes, choose_weight(), unless the conditions name one. Throws as solve() does, and std::invalid_argument with a
/// part that noise does not go with: motion in time, the simplified imposition, a region, cuts, tears, a resection, a
/// plane problem.
SolveResult solve_measured(const Model& model, const SolveOptions& options, const Progress& progress);

}  // namespace brainshift::solve
