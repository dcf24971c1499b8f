// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <unordered_map>
#include <vector>

#include "discretise/discretise.hpp"
#include "discretise/interface/background_cells.hpp"
#include "discretise/interface/node_cloud.hpp"

namespace brainshift::verification {

/// Irregular nodes by throwing darts: a node is kept when it lies no nearer than the least distance to the nodes before
/// it. Edges first, then faces, then the inside, so that the boundary is covered up to its edges. The same seed gives
/// the same cloud.
class Darts {
 public:
  /// fineness: the least distance at a place over least_distance, at most 1; empty: 1 everywhere.
  Darts(double least_distance, unsigned seed, std::function<double(const Eigen::Vector3d&)> fineness = {})
      : least_(least_distance), random_(seed), fineness_(std::move(fineness)) {}

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }

  /// True when the node was kept.
  bool put(const Eigen::Vector3d& position, bool on_surface);

  /// Throws until 3000 in a row were in vain.
  void fill(const std::function<Eigen::Vector3d()>& place, bool on_surface);

  /// Nodes along a closed or open line of the given length, evenly but for a tenth of their distance, as fine as its
  /// start.
  void along(double length, bool closed, const std::function<Eigen::Vector3d(double share)>& place);

  /// The cloud; its spacing is the mean distance to the six nearest nodes (planar: four).
  NodeCloud cloud(bool planar = false) const;

  double least_distance() const { return least_; }

 private:
  std::int64_t key(int i, int j, int k) const;

  double least_;
  std::mt19937_64 random_;
  std::function<double(const Eigen::Vector3d&)> fineness_;
  std::vector<Eigen::Vector3d> nodes_;
  std::vector<std::uint8_t> on_surface_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> buckets_;
};

/// A circle about the z axis.
struct Ring {
  double radius, z;
};

/// Nodes lie on the rings and are `fineness` times as far apart there, as elsewhere from `reach` mm on.
struct Grading {
  std::vector<Ring> rings = {};
  double fineness = 1;
  double reach = 1;
};

/// A cylinder along z from 0 to height, with nodes on both rims.
NodeCloud cylinder_cloud(double radius, double height, double least_distance, unsigned seed,
                         const Grading& grading = {});

/// The box from 0 to size. fineness: as of Darts.
NodeCloud box_cloud(const Eigen::Vector3d& size, double least_distance, unsigned seed,
                    std::function<double(const Eigen::Vector3d&)> fineness = {});

/// The rectangle from 0 to (width, height) in the plane. fineness: as of Darts.
NodeCloud rectangle_cloud(double width, double height, double least_distance, unsigned seed,
                          std::function<double(const Eigen::Vector3d&)> fineness = {});

/// The half of a ball about the origin with z ≥ 0, with nodes on the rim.
NodeCloud half_ball_cloud(double radius, double least_distance, unsigned seed);

/// An eighth of a hollow ball: x, y, z ≥ 0, between two radii.
NodeCloud hollow_ball_cloud(double inner, double outer, double least_distance, unsigned seed);

/// Regular hexahedra over a closed surface that do not conform to it, as `discretise` makes them.
/// refinement: as there, empty for none.
BackgroundCells cells_over(const Surface& surface, std::size_t nodes, double cells_per_node,
                           const std::optional<discretise::Refinement>& refinement = {});

/// Finer cells within `radius` mm of the rings of a grading.
discretise::Refinement refinement_about(const Grading& grading, double radius);

/// Closed surface of a cylinder along z, a prism of many sides.
Surface cylinder_surface(double radius, double height);

/// Closed surface of the half of a ball with z ≥ 0, of its volume to a thousandth.
Surface half_ball_surface(double radius);

}  // namespace brainshift::verification
