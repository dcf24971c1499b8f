// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "solve/interface/result.hpp"
#include "solve/measured/gaussian.hpp"
#include "solve/measured/response.hpp"

namespace brainshift::solve {

/// Chooses what is believed of the motion before it is measured, by restricted maximum likelihood (Patterson &
/// Thompson 1971), log_likelihood of MeasuredGaussian: the weight s of the deformation's energy, exp(−W/s), and, where
/// the response has sites, a smooth motion of the opening beside it, unless the points are as likely without: three
/// more numbers must gain three in the likelihood (Akaike 1974). One that does not is `refused`. s is searched where
/// the prior's standard deviation at the points is between a tenth of the usual σ (the lower quartile) and ten times
/// the largest |d|; a weight that is given (mJ) is taken alone. displacement, sigma: (m × 3) mm, of the first m points
/// of the response, of which the first 60 choose. `smoothed` are all m points; covariance and linear stay empty. Throws
/// std::invalid_argument where the points do not fix a rigid motion.
MeasuredFit choose_weight(const Response& response, const Points& displacement, const Points& sigma, double weight = 0);

/// What the linear body says of the displacements at the a places behind the m measured points of a response, by the
/// prior of a fit, with noise and prior as large as what was measured says (noise_factor). In the frame of the image:
/// of a body that is held the rigid motion is the patient's, not the brain's.
class Posterior {
 public:
  /// The response must outlive it. displacement, sigma: (m × 3) mm.
  Posterior(const Response& response, const Points& displacement, const Points& sigma, const MeasuredFit& fit);

  /// (a × 3) mm, what the answer's prior finds.
  Points mean() const;

  /// Joint, (3 places × 3 places) mm², of those from `first` on. It is to hold the truth, so it believes that the
  /// smooth motion is rougher, Alike::matern.
  Eigen::MatrixXd covariance(Eigen::Index first, Eigen::Index places) const;

 private:
  /// d (m) mm, variance (m) mm²; larger: times which noise and prior are what was measured.
  Posterior(const Response& response, const Eigen::VectorXd& d, const Eigen::VectorXd& variance, const MeasuredFit& fit,
            double larger);

  /// Of `places` from `first` on, (3 places × 6) or without columns.
  Eigen::MatrixXd rigid_of(Eigen::Index first, Eigen::Index places) const;

  const Response& response_;
  Eigen::Index measured_;  // components
  double factor_;
  Prior likely_, careful_;
  MeasuredGaussian answer_, doubt_;
};

/// xx, yy, zz, xy, yz, zx of a symmetric matrix: a row of a table of covariances.
using SixEntries = Eigen::Matrix<double, 1, 6>;
SixEntries six_entries(const Eigen::Matrix3d& c);

/// The covariance c (mm²) of a place as it is said once the answer is known; linear, answered: the displacement there,
/// mm, by the linear body and by the answer. The linear body of some hundred nodes that carries errors there slides
/// along its skull and never leaves it: far from the opening it may move by twice as much as the answer does, and
/// errors are carried as the motion is. So c is made smaller where the answer is, as far as that can be told from
/// errors. And the body knows better how large errors are than where they point: on a phantom and a FreeSurfer head
/// errors along the shortest axis were twice as long as that. So what is said is the mean of c and of the ball about
/// its longest axis.
SixEntries as_said(const SixEntries& c, const Eigen::RowVector3d& linear, const Eigen::RowVector3d& answered);

}  // namespace brainshift::solve
