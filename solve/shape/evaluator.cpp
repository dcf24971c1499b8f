// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/evaluator.hpp"

#include <cmath>

namespace brainshift::solve {

namespace {

constexpr double patience = 1.5;  // up to this growth MMLS looks for a support that needs no penalty
constexpr int opacity = 4;        // λ of the diffraction method

std::vector<double> support_radius(std::span<const double> spacing, double dilatation) {
  std::vector<double> radius(spacing.begin(), spacing.end());
  for (double& r : radius) {
    r *= dilatation;
  }
  return radius;
}

}  // namespace

ShapeFunctions::Impl::Impl(const Points& p, std::span<const double> spacing, const ShapeOptions& o,
                           std::shared_ptr<const Visibility> v)
    : positions(p),
      options(o),
      search(positions, support_radius(spacing, solve::dilatation(o))),
      visibility(std::move(v)) {}

Ball ball_about(std::span<const Place> points) {
  Eigen::Vector3d low = points[0].at, high = low;
  for (const Place& p : points) {
    low = low.cwiseMin(p.at);
    high = high.cwiseMax(p.at);
  }
  Ball ball{0.5 * (low + high), 0};
  for (const Place& p : points) {
    ball.extent = std::max(ball.extent, (p.at - ball.centre).squaredNorm());
  }
  constexpr double rounding = 1 + 1e-9;
  ball.extent = rounding * std::sqrt(ball.extent);
  return ball;
}

Candidates candidates_near(const ShapeFunctions::Impl& impl, const Ball& ball, double scale) {
  Candidates near;
  impl.search.find(ball.centre, scale, near.node, ball.extent);
  for (const std::int32_t node : near.node) {
    near.x.push_back(impl.positions(node, 0));
    near.y.push_back(impl.positions(node, 1));
    near.z.push_back(impl.positions(node, 2));
    near.radius.push_back(impl.search.radius()[static_cast<std::size_t>(node)]);
  }
  return near;
}

Evaluator::Evaluator(const ShapeFunctions::Impl& impl)
    : impl_(impl),
      options_{impl.options.planar ? 2 : 3, impl.options.basis == Basis::linear ? 1 : 2,
               impl.options.basis == Basis::modified_quadratic ? impl.options.penalty : 0, false} {}

std::span<const Slope> Evaluator::slopes() {
  slopes_.resize(std::max(slopes_.size(), count_));
  differentiate(sights(), pulls_, options_, impl_.options.derivatives, fit_, slopes_.data());
  return std::span(slopes_).first(count_);
}

/// Lanes without a point are at the last one, and not wanted.
void Evaluator::place(std::span<const Place> points, Places& places, Mask& wanted) {
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

void Evaluator::fit(const Places& places, const Candidates& near) {
  sights_.resize(std::max(sights_.size(), near.node.size()));
  count_ = look(near, scale_, places, sights_.data());
  look_past_cut(places);
  options_.leave_to_penalty = options_.penalty > 0 && scale_ > patience;
  fit_shape(std::span(sights_).first(count_), options_, fit_);
}

void Evaluator::look_past_cut(const Places& places) {
  pulls_.clear();
  for (int l = 0; impl_.visibility && l < lanes; ++l) {
    const Eigen::Vector3d x(places.at[0][l], places.at[1][l], places.at[2][l]);
    double farthest = -1;
    for (const Sight& s : sights()) {
      farthest = s.seen_from(l) ? std::max(farthest, s.distance[l]) : farthest;
    }
    if (farthest >= 0 && impl_.visibility->near(x, farthest)) {
      look_past_cut(l, x);
    }
  }
}

/// Takes the nodes that the cut hides out of the support, and counts those behind its front as farther.
void Evaluator::look_past_cut(int lane, const Eigen::Vector3d& x) {
  if (pulls_.empty()) {
    for (const Sight& s : sights()) {
      pulls_.push_back({{s.away[0], s.away[1], s.away[2]}});
    }
  }
  for (std::size_t a = 0; a < count_; ++a) {
    Sight& s = sights_[a];
    if (!s.seen_from(lane)) {
      continue;
    }
    const Eigen::Vector3d node = impl_.positions.row(s.node), away = node - x;
    if (const std::optional<Detour> detour = impl_.visibility->detour(x, node)) {
      const double straight = s.distance[lane], ratio = detour->length / straight;
      const Eigen::Vector3d gradient = opacity * std::pow(ratio, opacity - 1) * detour->gradient +
                                       (opacity - 1) * std::pow(ratio, opacity) / straight * away;
      s.distance[lane] = straight * std::pow(ratio, opacity);
      for (int axis = 0; axis < 3; ++axis) {
        pulls_[a].axis[axis][lane] = s.seen_from(lane) ? -s.distance[lane] * gradient[axis] : 0;
      }
    }
  }
}

}  // namespace brainshift::solve
