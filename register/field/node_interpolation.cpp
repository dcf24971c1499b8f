// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/node_interpolation.hpp"

#include <algorithm>

namespace brainshift::registration {

namespace {

std::vector<BatchNode> batch_nodes(const Solution& solution, const Points& parameters) {
  const double dilatation = solve::dilatation(solution.shape);
  std::vector<BatchNode> nodes(solution.spacing.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto row = static_cast<Eigen::Index>(n);
    nodes[n].radius = dilatation * solution.spacing[n];
    for (int axis = 0; axis < 3; ++axis) {
      nodes[n].position[axis] = solution.positions(row, axis);
      nodes[n].parameter[axis] = parameters(row, axis);
    }
  }
  return nodes;
}

std::vector<double> widened_radii(const std::vector<BatchNode>& nodes, double by) {
  std::vector<double> radii;
  for (const BatchNode& node : nodes) {
    radii.push_back(node.radius + by);
  }
  return radii;
}

bool meets(const BatchNode& node, const Eigen::Vector3d& centre, double radius) {
  const double seen_within = node.radius + radius;
  return (Eigen::Map<const Eigen::Vector3d>(node.position) - centre).squaredNorm() < seen_within * seen_within;
}

}  // namespace

NodeInterpolation::NodeInterpolation(const Solution& solution, const Points& parameters, double widest)
    : positions_(solution.positions),
      nodes_(batch_nodes(solution, parameters)),
      shape_(solution.shape),
      widest_(widest),
      largest_radius_(std::max_element(nodes_.begin(), nodes_.end(),
                                       [](const auto& a, const auto& b) { return a.radius < b.radius; })
                          ->radius),
      search_(positions_, widened_radii(nodes_, widest)) {
  if (!solution.cut.empty()) {
    cut_.emplace(solution.cut);
  }
}

NodeInterpolation::Ball NodeInterpolation::ball_around(std::span<const Eigen::Vector3d> places) {
  Eigen::Vector3d low = places.front(), high = low;
  for (const Eigen::Vector3d& place : places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  return {(low + high) / 2, (high - low).norm() / 2};
}

std::vector<BatchNode> NodeInterpolation::nodes_seen_from(const Ball& ball) const {
  std::vector<solve::Supporter> found;
  search_.find(ball.centre, 1, found);
  std::vector<BatchNode> nodes;
  for (const solve::Supporter& s : found) {
    const BatchNode& node = nodes_[static_cast<std::size_t>(s.node)];
    if (meets(node, ball.centre, ball.radius)) {
      nodes.push_back(node);
    }
  }
  return nodes;
}

void NodeInterpolation::at(std::span<const Eigen::Vector3d> places,
                           std::span<std::optional<Eigen::Vector3d>> displacement) const {
  std::fill(displacement.begin(), displacement.end(), std::nullopt);
  if (places.empty() || shape_.planar) {
    return;
  }
  const Ball ball = ball_around(places);
  if (ball.radius > widest_ || (cut_ && cut_->near(ball.centre, ball.radius + largest_radius_))) {
    return;
  }
  const std::vector<BatchNode> nodes = nodes_seen_from(ball);
  for (std::size_t begin = 0; begin < places.size(); begin += batch_size) {
    const std::size_t count = std::min<std::size_t>(batch_size, places.size() - begin);
    interpolate(nodes, places.subspan(begin, count), displacement.subspan(begin, count));
  }
}

void NodeInterpolation::interpolate(std::span<const BatchNode> nodes, std::span<const Eigen::Vector3d> places,
                                    std::span<std::optional<Eigen::Vector3d>> displacement) const {
  const Ball ball = ball_around(places);
  std::vector<BatchNode> near;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(near),
               [&](const BatchNode& node) { return meets(node, ball.centre, ball.radius); });
  PlaceBatch batch{near, largest_radius_, shape_.basis == Basis::modified_quadratic ? shape_.penalty : 0, {}, {}, {}};
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t lane = 0; lane < batch_size; ++lane) {
      batch.place[axis][lane] = places[std::min(lane, places.size() - 1)][axis];
    }
  }
  shape_.basis == Basis::linear ? interpolate_linear(batch) : interpolate_quadratic(batch);
  for (std::size_t lane = 0; lane < places.size(); ++lane) {
    if (batch.sure[lane] > 0) {
      displacement[lane] =
          Eigen::Vector3d(batch.displacement[0][lane], batch.displacement[1][lane], batch.displacement[2][lane]);
    }
  }
}

}  // namespace brainshift::registration
