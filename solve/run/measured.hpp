// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"
#include "solve/load/contradictions.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/run/thinned_body.hpp"

namespace brainshift::solve {

/// What measured points say of the weight, the noise and a rigid motion, by the thinned body: choose_weight().
/// conditions: at the nodes of the whole cloud. The covariance is posterior()'s. Throws as solve() does.
MeasuredFit fit_measured(const ThinnedBody& thinned, const Conditions& conditions);

/// Its covariance at the places that were asked for as_said() by the answer to it. displacement: the answer's, at the
/// nodes of the whole cloud, (n × 3) mm. Throws as solve() does.
void say_by_answer(const ThinnedBody& thinned, const Points& asked, const Points& displacement, MeasuredFit& fit);

/// What noise and prior leave open of the displacement at each node of the model's cloud, (n × 6) mm²: xx, yy, zz, xy,
/// yz, zx of its covariance, with the weight and the noise_factor of the fit; of the thinned body, whose shape
/// functions carry it to the others, and, as at landmarks, of the mean over a ball of seen_radius, as_said() by the
/// answer, displacement, (n × 3) mm; 0 at nodes that are held. Throws as solve() does.
Eigen::MatrixXd measured_covariance(const Model& model, const SolveOptions& options, const MeasuredFit& fit,
                                    const Points& displacement);

/// The measured points that contradict the others, the farthest off first: by the energy of the deformation alone as
/// prior, more than five standard deviations off, and five times farther than is usual of this load (where all are far
/// off, σ is too small, and no point is to blame). The others count with robust weights, as one wrong point hides
/// another. Throws as solve() does.
std::vector<Outlier> outliers(const ThinnedBody& thinned, const Conditions& conditions);

/// Lets the measured points that contradict the others count for less: the conditions are made anew,
/// noisy_conditions(), without those that robust_trust() leaves nothing, and with the standard deviations of the
/// others raised by the root of their weights. Of a load of points with noise, not of a field. Throws as
/// solve_measured() and noisy_conditions() do.
LessenedPoints lessen_outliers(Model& model, const SolveOptions& options, const OpeningOptions& opening);

/// Conditions as a fit weighs them: with its weight and, where it has a smooth motion of the opening, what that leaves
/// of the noise taken out and the opening held.
Conditions weighed_conditions(Conditions conditions, const MeasuredFit& fit);

/// solve() of a model whose conditions were measured with noise: the prior is chosen on a cloud of some hundred of the
/// nodes, choose_weight(), unless the conditions name a weight. Throws as solve() does, and std::invalid_argument with
/// a part that noise does not go with: motion in time, the simplified imposition, a region, cuts, tears, a septum, a
/// resection, a plane problem.
SolveResult solve_measured(const Model& model, const SolveOptions& options, const Progress& progress);

}  // namespace brainshift::solve
