// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// Finds the support of a point: all nodes a with |x − X_a| < scale · radius_a. Nodes are held in one k-d tree an
/// octave of radius, so that a cloud with spacings from 1 to 20 costs little more than a uniform one.
class SupportSearch {
 public:
  /// positions (n × 3) mm, radius one a node, mm, > 0. The positions must outlive the search.
  SupportSearch(const Points& positions, std::vector<double> radius);
  ~SupportSearch();
  SupportSearch(SupportSearch&&) noexcept;

  /// Replaces found by the nodes of the support of x, ascending. extent: by how much farther than their radii nodes may
  /// be, so that the supports of all places as near to x are found; mm.
  void find(const Eigen::Vector3d& x, double scale, std::vector<std::int32_t>& found, double extent = 0) const;
  std::span<const double> radius() const { return radius_; }

 private:
  struct Level;
  std::vector<double> radius_;
  std::vector<std::unique_ptr<Level>> levels_;
};

}  // namespace brainshift::solve
