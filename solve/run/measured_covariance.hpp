// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"
#include "solve/measured/response.hpp"
#include "solve/run/measured_points.hpp"

namespace brainshift::solve {

/// Fills `linear` and `covariance` of a fit with the Posterior at the places that were asked for, which follow the
/// measured points in the response.
void add_posterior(const MeasuredPoints& measured, const Response& response, MeasuredFit& fit);

/// The covariance of a fit at the places that were asked for, as_said() by the answer to it. displacement: the
/// answer's, at the nodes of the whole cloud, (n × 3) mm. Throws as solve() does.
void say_by_answer(const ThinnedBody& thinned, const Points& asked, const Points& displacement, MeasuredFit& fit);

/// What noise and prior leave open of the displacement at each node of the model's cloud, (n × 6) mm²: xx, yy, zz, xy,
/// yz, zx of its covariance, with the weight and the noise_factor of the fit; of the thinned body, whose shape
/// functions carry it to the others, and, as at landmarks, of the mean over a ball of seen_radius, as_said() by the
/// answer, displacement, (n × 3) mm; 0 at nodes that are held. Throws as solve() does.
Eigen::MatrixXd measured_covariance(const Model& model, const SolveOptions& options, const MeasuredFit& fit,
                                    const Points& displacement);

}  // namespace brainshift::solve
