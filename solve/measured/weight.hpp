// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "solve/interface/result.hpp"
#include "solve/measured/response.hpp"

namespace brainshift::solve {

/// Chooses the weight s of the deformation's energy against the misfit by restricted maximum likelihood (Patterson &
/// Thompson 1971): with exp(−W/s) as prior the displacements d at the points are Gaussian with covariance
/// V = s G + diag(σ²), about a rigid motion that is not known where nothing holds the body, and
///   log L = −½ (dᵀ P d + log|V| + log|Xᵀ V⁻¹ X|),  P = V⁻¹ − V⁻¹ X (Xᵀ V⁻¹ X)⁻¹ Xᵀ V⁻¹.
/// s is searched where the prior's standard deviation at the points is between a tenth of the mean σ and ten times the
/// largest |d|, unless a weight is given (mJ). displacement, sigma: (m × 3) mm, of the first m points of the response;
/// of those behind them the covariance of the displacement is given, with noise and prior as large as what was measured
/// says (noise_factor). Throws std::invalid_argument where the points do not fix a rigid motion.
MeasuredFit choose_weight(const Response& response, const Points& displacement, const Points& sigma, double weight = 0);

/// The joint covariance (mm²) of all displacements behind the m measured points of the response, (3a × 3a), under the
/// weight and with the noise_factor of a fit: s G of the prior less what the measured points say. sigma: (m × 3) mm.
Eigen::MatrixXd posterior_covariance(const Response& response, const Points& sigma, const MeasuredFit& fit);

/// How far each measured point lies from what all others and the prior of the weight (mJ) say of it: in standard
/// deviations of that distance, noise of the point among it, over x, y and z together. displacement, sigma: (m × 3) mm.
/// Returns m; of a Gaussian the squares are chi-squared with three degrees of freedom.
Eigen::VectorXd surprise(const Response& response, const Points& displacement, const Points& sigma, double weight);

/// What of each measured point's weight is left where points that contradict the others count for less, m values from
/// least_trust to 1: Tukey's biweight (1 − (r/c)²)², 0 from r = c on, of r = surprise() with the point's own σ and all
/// others as they are weighed, over what is usual of this load where that is more than it should be. Found by weighing
/// anew, as registration of images does it (Reuter et al. 2010, NeuroImage 53:1181), s too unless it is given (mJ). c
/// keeps 95 % of the efficiency where the noise is Gaussian. displacement, sigma: (m × 3) mm. Throws as
/// choose_weight().
Eigen::VectorXd robust_weights(const Response& response, const Points& displacement, const Points& sigma,
                               double weight);

/// Stands for a weight of 0.
inline constexpr double least_trust = 1e-3;

/// The median of surprise() where the noise is Gaussian: of the root of chi-squared with three degrees of freedom.
inline constexpr double usual_surprise = 1.54;

/// xx, yy, zz, xy, yz, zx of a symmetric matrix: a row of a table of covariances.
Eigen::Matrix<double, 1, 6> six_entries(const Eigen::Matrix3d& c);

}  // namespace brainshift::solve
