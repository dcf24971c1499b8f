// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "solve/interface/result.hpp"
#include "solve/measured/response.hpp"

namespace brainshift::solve {

/// Chooses what is believed of the motion before it is measured, by restricted maximum likelihood (Patterson &
/// Thompson 1971), log_likelihood of MeasuredGaussian: the weight s of the deformation's energy, exp(−W/s), and, where
/// the response has sites, a smooth motion of the opening beside it, unless the points are as likely without: three
/// more numbers must gain three in the likelihood (Akaike 1974). s is searched where the prior's standard deviation at
/// the points is between a tenth of the mean σ and ten times the largest |d|; a weight that is given (mJ) is taken
/// alone. displacement, sigma: (m × 3) mm, of the first m points of the response, of which the first 60 choose; of
/// those behind them the covariance of the displacement is given, with noise and prior as large as what was measured
/// says (noise_factor). `smoothed` are all m points. Throws std::invalid_argument where the points do not fix a rigid
/// motion.
MeasuredFit choose_weight(const Response& response, const Points& displacement, const Points& sigma, double weight = 0);

/// The joint covariance (mm²) of all displacements behind the m measured points of the response, (3a × 3a), under the
/// prior and with the noise_factor of a fit: the prior's less what the measured points say. sigma: (m × 3) mm.
Eigen::MatrixXd posterior_covariance(const Response& response, const Points& sigma, const MeasuredFit& fit);

/// xx, yy, zz, xy, yz, zx of a symmetric matrix: a row of a table of covariances.
Eigen::Matrix<double, 1, 6> six_entries(const Eigen::Matrix3d& c);

}  // namespace brainshift::solve
