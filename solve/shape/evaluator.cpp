// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/evaluator.hpp"

#include <cmath>

namespace brainshift::solve {

namespace {

constexpr double patience = 1.5;  // up to this growth MMLS looks for a support that needs no penalty
constexpr int opacity = 4;        // λ of the diffraction method

}  // namespace

Ball ball_about(std::span<const EvaluationPoint> points) {
  Eigen::Vector3d low = points[0].at, high = low;
  for (const EvaluationPoint& p : points) {
    low = low.cwiseMin(p.at);
    high = high.cwiseMax(p.at);
  }
  Ball ball{0.5 * (low + high), 0};
  for (const EvaluationPoint& p : points) {
    ball.extent = std::max(ball.extent, (p.at - ball.centre).squaredNorm());
  }
  constexpr double rounding = 1 + 1e-9;
  ball.extent = rounding * std::sqrt(ball.extent);
  return ball;
}

Candidates candidates_near(const NodeSupports& supports, const Ball& ball, double scale) {
  Candidates near;
  supports.search.find(ball.centre, scale, near.node, ball.extent);
  for (const std::int32_t node : near.node) {
    near.x.push_back(supports.positions(node, 0));
    near.y.push_back(supports.positions(node, 1));
    near.z.push_back(supports.positions(node, 2));
    near.radius.push_back(supports.search.radius()[static_cast<std::size_t>(node)]);
  }
  return near;
}

Evaluator::Evaluator(const NodeSupports& supports, double largest_growth)
    : supports_(supports),
      largest_growth_(largest_growth),
      options_{supports.options.planar ? 2 : 3, supports.options.basis == Basis::linear ? 1 : 2,
               supports.options.basis == Basis::modified_quadratic ? supports.options.penalty : 0, false} {}

std::span<const ShapeGradient> Evaluator::gradients() {
  gradients_.resize(std::max(gradients_.size(), count_));
  differentiate(neighbours(), distance_gradients_, options_, supports_.options.derivatives, fit_, gradients_.data());
  return std::span(gradients_).first(count_);
}

/// Lanes without a point are at the last one, and not wanted.
void Evaluator::place(std::span<const EvaluationPoint> points, PointLanes& places, Mask& wanted) {
  places.ball = ball_about(points);
  for (std::size_t l = 0; l < lanes; ++l) {
    wanted[l] = l < points.size() ? -1 : 0;
    const Eigen::Vector3d& x = points[std::min(l, points.size() - 1)].at;
    for (int axis = 0; axis < 3; ++axis) {
      places.at[axis][l] = x[axis];
    }
  }
}

int Evaluator::first_of(const Mask& mask) {
  int lane = 0;
  while (lane < lanes && mask[lane] == 0) {
    ++lane;
  }
  return lane < lanes ? lane : -1;
}

void Evaluator::fit(const PointLanes& places, const Candidates& near) {
  neighbours_.resize(std::max(neighbours_.size(), near.node.size()));
  count_ = find_neighbours(near, scale_, places, neighbours_.data());
  apply_visibility(places);
  options_.leave_to_penalty = options_.penalty > 0 && scale_ > patience;
  fit_shape(std::span(neighbours_).first(count_), options_, fit_);
}

void Evaluator::apply_visibility(const PointLanes& places) {
  distance_gradients_.clear();
  for (int l = 0; supports_.visibility && l < lanes; ++l) {
    const Eigen::Vector3d x(places.at[0][l], places.at[1][l], places.at[2][l]);
    double farthest = -1;
    for (const Neighbour& s : neighbours()) {
      farthest = s.supports(l) ? std::max(farthest, s.distance[l]) : farthest;
    }
    if (farthest >= 0 && supports_.visibility->near(x, farthest)) {
      apply_visibility(l, x);
    }
  }
}

/// Takes the nodes that the cut hides out of the support, and counts those behind its front as farther.
void Evaluator::apply_visibility(int lane, const Eigen::Vector3d& x) {
  if (distance_gradients_.empty()) {
    for (const Neighbour& s : neighbours()) {
      distance_gradients_.push_back({{s.away[0], s.away[1], s.away[2]}});
    }
  }
  for (std::size_t a = 0; a < count_; ++a) {
    Neighbour& s = neighbours_[a];
    if (!s.supports(lane)) {
      continue;
    }
    const Eigen::Vector3d node = supports_.positions.row(s.node), away = node - x;
    if (const std::optional<Detour> detour = supports_.visibility->detour(x, node)) {
      const double straight = s.distance[lane], ratio = detour->length / straight;
      const Eigen::Vector3d gradient = opacity * std::pow(ratio, opacity - 1) * detour->gradient +
                                       (opacity - 1) * std::pow(ratio, opacity) / straight * away;
      s.distance[lane] = straight * std::pow(ratio, opacity);
      for (int axis = 0; axis < 3; ++axis) {
        distance_gradients_[a].axis[axis][lane] = s.supports(lane) ? -s.distance[lane] * gradient[axis] : 0;
      }
    }
  }
}

}  // namespace brainshift::solve
