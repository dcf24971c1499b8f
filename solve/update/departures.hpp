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
  /// that the responses are of, (n × 3) mm. The oldest answer is forgotten when there are too many.
  void learn(const Responses& responses, const Points& change, const NodalVectors& first_order,
             const NodalVectors& answer);

  /// Adds what is to be expected to û of the first order.
  void add_expected(const Responses& responses, const Points& change, NodalVectors& first_order) const;

 private:
  struct Lesson {
    Eigen::VectorXd change, short_waves;  ///< over the responses' nodes; root mean squares of a node, mm
    Eigen::VectorXf departure;            ///< of û, mm
  };
  static Lesson lesson_of(const Responses& responses, const Points& change);
  static double covariance(const Lesson& a, const Lesson& b);

  std::deque<Lesson> lessons_;
};

}  // namespace brainshift::solve
