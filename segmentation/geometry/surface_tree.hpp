// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

/// The nearest place of a surface.
struct SurfacePlace {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< unit, the pseudonormal of the face, edge or vertex: rounding does not choose a triangle
  Eigen::Index triangle;   ///< of the surface
  bool on_rim;             ///< on an edge that only one triangle has
};

/// Nearest places on a surface, open or closed. Flat triangles are left out. Const calls may run on many threads.
class SurfaceTree {
 public:
  /// Throws std::invalid_argument when no triangle has an area.
  explicit SurfaceTree(const Surface& surface);

  SurfacePlace nearest(const Eigen::Vector3d& position) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace brainshift
