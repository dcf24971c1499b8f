// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/node_interpolation.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace brainshift::registration {

namespace {

constexpr double growth = 1.1;       // of a support that is not admissible, each try, as the solver does it
constexpr double most_growth = 1.5;  // from there on the solver leaves terms to the penalty

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

NodeInterpolation::Ball NodeInterpolation::ball_around(std::span<const Place> places, Indices of) {
  Eigen::Vector3d low = places[of.front()], high = low;
  for (const std::size_t i : of) {
    low = low.cwiseMin(places[i]);
    high = high.cwiseMax(places[i]);
  }
  return {(low + high) / 2, (high - low).norm() / 2};
}

std::vector<BatchNode> NodeInterpolation::nodes_seen_from(const Ball& ball, double scale) const {
  std::vector<solve::Supporter> found;
  search_.find(ball.centre, scale, found);
  std::vector<BatchNode> nodes;
  for (const solve::Supporter& s : found) {
    BatchNode node = nodes_[static_cast<std::size_t>(s.node)];
    node.radius *= scale;
    if (meets(node, ball.centre, ball.radius)) {
      nodes.push_back(node);
    }
  }
  return nodes;
}

void NodeInterpolation::at(std::span<const Place> places, std::span<Displacement> displacement) const {
  std::fill(displacement.begin(), displacement.end(), std::nullopt);
  std::vector<std::size_t> open(places.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  for (double scale = 1; scale < most_growth && !open.empty() && !shape_.planar; scale *= growth) {
    const Ball ball = ball_around(places, open);
    if (ball.radius > widest_ || (cut_ && cut_->near(ball.centre, ball.radius + scale * largest_radius_))) {
      return;
    }
    const std::vector<BatchNode> nodes = nodes_seen_from(ball, scale);
    std::vector<std::size_t> inadmissible;
    for (std::size_t begin = 0; begin < open.size(); begin += batch_size) {
      const Indices batch = Indices(open).subspan(begin, std::min<std::size_t>(batch_size, open.size() - begin));
      const std::vector<std::size_t> to_grow = interpolate(nodes, places, batch, displacement);
      inadmissible.insert(inadmissible.end(), to_grow.begin(), to_grow.end());
    }
    open = std::move(inadmissible);
  }
}

/// Returns the places whose support must be grown.
std::vector<std::size_t> NodeInterpolation::interpolate(std::span<const BatchNode> nodes, std::span<const Place> places,
                                                        Indices batch, std::span<Displacement> displacement) const {
  const Ball ball = ball_around(places, batch);
  std::vector<BatchNode> near;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(near),
               [&](const BatchNode& node) { return meets(node, ball.centre, ball.radius); });
  PlaceBatch lanes{near, largest_radius_, shape_.basis == Basis::modified_quadratic ? shape_.penalty : 0, {}, {}, {}};
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t lane = 0; lane < batch_size; ++lane) {
      lanes.place[axis][lane] = places[batch[std::min(lane, batch.size() - 1)]][axis];
    }
  }
  shape_.basis == Basis::linear ? interpolate_linear(lanes) : interpolate_quadratic(lanes);
  std::vector<std::size_t> inadmissible;
  for (std::size_t lane = 0; lane < batch.size(); ++lane) {
    if (lanes.verdict[lane] > 0) {
      displacement[batch[lane]].emplace(lanes.displacement[0][lane], lanes.displacement[1][lane],
                                        lanes.displacement[2][lane]);
    } else if (lanes.verdict[lane] < 0) {
      inadmissible.push_back(batch[lane]);
    }
  }
  return inadmissible;
}

}  // namespace brainshift::registration
