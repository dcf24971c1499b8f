// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "solve/shape/moving_least_squares.hpp"
#include "solve/shape/node_supports.hpp"

namespace brainshift::solve {

/// A point to evaluate at.
struct EvaluationPoint {
  Eigen::Vector3d at;
  std::int32_t point;
};

Ball ball_about(std::span<const EvaluationPoint> points);

/// The nodes that places in a ball may see. scale: of the supports.
Candidates candidates_near(const NodeSupports& supports, const Ball& ball, double scale);

/// Evaluates the shape functions at some neighbouring points, a lane each; owned by one thread.
class Evaluator {
 public:
  /// largest_growth: of the radii of supports.
  Evaluator(const NodeSupports& supports, double largest_growth);

  /// Finds admissible supports of the points, at most as many as there are lanes, growing them where needed: calls
  /// use(found) with the lanes where that was enough, as long as neighbours and gradients are theirs. near: all nodes
  /// near the points. Returns a lane for which there is none, or -1.
  template <class Use>
  int move_to(std::span<const EvaluationPoint> points, const Candidates& near, const Use& use) {
    PointLanes places{};
    Mask wanted{};
    place(points, places, wanted);
    for (scale_ = 1; scale_ <= largest_growth_ && any(wanted); scale_ *= growth) {
      for (int l = 0; l < lanes; ++l) {
        places.unwanted[l] = wanted[l] != 0 ? 0 : std::numeric_limits<double>::infinity();
      }
      if (grown()) {
        fit(places, candidates_near(supports_, places.ball, scale_));
      } else {
        fit(places, near);
      }
      const Mask found = wanted & fit_.admissible;
      if (any(found)) {
        use(found);
      }
      wanted &= ~found;
    }
    return first_of(wanted);
  }

  bool grown() const { return scale_ > 1; }
  std::int64_t support_size(int lane) const { return fit_.count[lane]; }
  std::span<const Neighbour> neighbours() const { return std::span(neighbours_).first(count_); }
  std::span<const ShapeGradient> gradients();

 private:
  static constexpr double growth = 1.1;  // of a support that is not admissible, each try

  static void place(std::span<const EvaluationPoint> points, PointLanes& places, Mask& wanted);
  static int first_of(const Mask& mask);
  void fit(const PointLanes& places, const Candidates& near);
  void apply_visibility(const PointLanes& places);
  void apply_visibility(int lane, const Eigen::Vector3d& x);

  const NodeSupports& supports_;
  double largest_growth_;
  FitOptions options_;
  Fit fit_;
  double scale_ = 1;
  std::size_t count_ = 0;
  std::vector<Neighbour> neighbours_;                 ///< count_ of them count
  std::vector<DistanceGradient> distance_gradients_;  ///< one a neighbour where a cut is near, else none
  std::vector<ShapeGradient> gradients_;
};

}  // namespace brainshift::solve
