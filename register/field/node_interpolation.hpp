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
/// their nodes, and eight at a time their sums and equations.
class NodeInterpolation {
 public:
  /// parameters: û of the solution's nodes. widest: no place lies farther from the middle of those of its call, mm.
  NodeInterpolation(const Solution& solution, const Points& parameters, double widest);

  /// displacement[i] at places[i], as ShapeFunctions::interpolate() has it, to rounding; none where the support is so
  /// poor that it may have to be grown, and where a cut may hide nodes: ask ShapeFunctions there. Places should follow
  /// each other as neighbours do. May run on many threads.
  void at(std::span<const Eigen::Vector3d> places, std::span<std::optional<Eigen::Vector3d>> displacement) const;

 private:
  struct Ball {
    Eigen::Vector3d centre;
    double radius;
  };
  static Ball ball_around(std::span<const Eigen::Vector3d> places);
  std::vector<BatchNode> nodes_seen_from(const Ball& ball) const;
  void interpolate(std::span<const BatchNode> nodes, std::span<const Eigen::Vector3d> places,
                   std::span<std::optional<Eigen::Vector3d>> displacement) const;

  Points positions_;
  std::vector<BatchNode> nodes_;
  ShapeOptions shape_;
  double widest_;
  double largest_radius_;
  solve::SupportSearch search_;
  std::optional<solve::Visibility> cut_;
};

}  // namespace brainshift::registration
