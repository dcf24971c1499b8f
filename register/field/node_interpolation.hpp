// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "register/field/place_batch.hpp"
#include "solve/cut/visibility.hpp"
#include "solve/shape/support_search.hpp"
#include "solve/solution.hpp"

namespace brainshift::registration {

/// Σφ_a(x) û_a at places that lie near one another, such as the voxels of a small brick: they share the search for
/// their nodes, and a batch of them its sums and equations.
class NodeInterpolation {
 public:
  using Place = Eigen::Vector3d;
  using Displacement = std::optional<Eigen::Vector3d>;

  /// parameters: û of the solution's nodes. widest: places of a call that lie farther from their middle are left, mm.
  NodeInterpolation(const Solution& solution, const Points& parameters, double widest);

  /// displacement[i] at places[i] as ShapeFunctions::interpolate() has it, to rounding; none where it is better asked:
  /// where the support is hardly admissible or must be grown far, and where a cut may hide nodes. Places should follow
  /// each other as neighbours do. May run on many threads.
  void at(std::span<const Place> places, std::span<Displacement> displacement) const;

 private:
  struct Ball {
    Eigen::Vector3d centre;
    double radius;
  };
  using Indices = std::span<const std::size_t>;

  static Ball ball_around(std::span<const Place> places, Indices of);
  std::vector<BatchNode> nodes_seen_from(const Ball& ball, double scale) const;
  std::vector<std::size_t> interpolate(std::span<const BatchNode> nodes, std::span<const Place> places, Indices batch,
                                       std::span<Displacement> displacement) const;

  Points positions_;
  std::vector<BatchNode> nodes_;
  ShapeOptions shape_;
  double widest_;
  double largest_radius_;
  solve::SupportSearch search_;
  std::optional<solve::Visibility> cut_;
};

}  // namespace brainshift::registration
