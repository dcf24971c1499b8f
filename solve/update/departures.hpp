// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <deque>

#include "solve/arrays/nodal_vectors.hpp"
#include "solve/update/responses.hpp"

namespace brainshift::solve {

/// What the responses of the first order leave open, learned from the answers so far. The departure of an answer from
/// the first order is taken for a Gaussian process over the load's change: one part goes with the square of the change,
/// one with its waves that are too short for the responses, and what relaxation left open counts as noise. Only a start
/// comes from it.
class Departures {
 public:
  /// An answer and what the first order said of it, mm, both û in the body's order. change: of the load from the one
  /// that the responses are of, (n × 3) mm, of the responses' nodes alone. An answer to nearly the same change is
  /// forgotten for it, and the oldest when there are too many.
  /// error_bound: of the answer, mm.
  void learn(const Responses& responses, const Points& change, const NodalVectors& first_order,
             const NodalVectors& answer, double error_bound);

  /// Adds what is to be expected to û of the first order.
  void add_expected(const Responses& responses, const Points& change, NodalVectors& first_order) const;

 private:
  struct Lesson {
    Eigen::VectorXd change, short_waves;  ///< at the responses' nodes, over √nodes: norms are root mean squares, mm
    Eigen::Matrix3Xf departure;           ///< of û, mm
    double left_open;                     ///< standard deviation of the departure, mm
  };
  static Lesson lesson_of(const Responses& responses, const Points& change);
  static double covariance(const Lesson& a, const Lesson& b);
  /// To twice the largest that was learned.
  void shorten(Eigen::VectorXd& asked, Eigen::VectorXd Lesson::*part) const;

  std::deque<Lesson> lessons_;
};

}  // namespace brainshift::solve
