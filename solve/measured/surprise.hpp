// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "solve/interface/result.hpp"
#include "solve/measured/response.hpp"

namespace brainshift::solve {

/// How far each measured point lies from what all others and the prior of a fit say of it: in standard deviations of
/// that distance, noise of the point among it, over x, y and z together. displacement, sigma: (m × 3) mm; weighed: the
/// standard deviations that the others count with. Returns m; of a Gaussian whose points are weighed as they are the
/// squares are chi-squared with three degrees of freedom.
Eigen::VectorXd surprise(const Response& response, const Points& displacement, const Points& sigma,
                         const Points& weighed, const MeasuredFit& fit);

/// What robust weights make of each of m measured points.
struct Trust {
  Eigen::VectorXd weight;    ///< what is left of its weight, least_trust to 1
  Eigen::VectorXd surprise;  ///< with all others weighed so, over what is usual of this load
};

/// Points that contradict the others count for less: by Tukey's biweight (1 − (r/c)²)², 0 from r = c on, of r =
/// surprise() over what is usual of this load where that is more than it should be. Found by weighing anew, as
/// registration of images does it (Reuter et al. 2010, NeuroImage 53:1181), s too unless it is given (mJ). c keeps 95 %
/// of the efficiency where the noise is Gaussian. displacement, sigma: (m × 3) mm. Throws as choose_weight().
Trust robust_trust(const Response& response, const Points& displacement, const Points& sigma, double weight);

/// Stands for a weight of 0.
inline constexpr double least_trust = 1e-3;
}  // namespace brainshift::solve
