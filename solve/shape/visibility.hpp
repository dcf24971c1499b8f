// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "segmentation/geometry/triangle_tree.hpp"
#include "solve/interface/cut.hpp"

namespace brainshift::solve {

/// A place about the end of a segment by its level sets (Wittek et al., figure 9; METHOD.md (30)): ψ from the line of
/// the segment, positive on the right of its direction V; φ along V from the end on. Their signs tell the four regions.
struct LevelSets {
  double psi, phi;  ///< mm
};
LevelSets level_sets(const Eigen::Vector3d& x, const Eigen::Vector3d& end, const Eigen::Vector3d& direction);

/// Of each vertex the lowest that it hangs together with by facets.
std::vector<std::int32_t> pieces_of(const CutFacets& cut);

/// The way round a cut, over its front.
struct Detour {
  double length;             ///< mm; infinite where there is no front
  Eigen::Vector3d gradient;  ///< of the length by the point that looks
};

/// Who sees whom past a cut: the visibility criterion. A place on a facet is on the side of its normal (a segment's
/// left).
class Visibility {
 public:
  explicit Visibility(CutFacets facets);

  /// Whether part of the cut lies within reach, mm, of x.
  bool near(const Eigen::Vector3d& x, double reach) const;

  /// The shortest way from x to a node round the cut that their line crosses, the longest where it crosses several;
  /// none: x sees the node.
  std::optional<Detour> detour(const Eigen::Vector3d& x, const Eigen::Vector3d& node) const;

  const CutFacets& facets() const { return facets_; }

 private:
  struct Plane {
    Eigen::Vector3d origin, normal;
  };

  struct FrontEdge {
    Eigen::Vector3d begin, along, middle;  ///< along: a unit vector, zero of an edge without length
    double length;
    std::int32_t piece;
  };

  bool segment_between(std::size_t facet, const Eigen::Vector3d& x, const Eigen::Vector3d& node) const;
  bool between(std::size_t facet, const Eigen::Vector3d& x, const Eigen::Vector3d& node) const;
  Detour round(std::int32_t piece, const Eigen::Vector3d& x, const Eigen::Vector3d& node) const;
  Eigen::Vector3d vertex(std::int32_t i) const { return facets_.vertices.row(i); }

  CutFacets facets_;
  std::vector<Plane> plane_;         ///< of each facet
  std::vector<std::int32_t> piece_;  ///< of each vertex: those that hang together have the same
  std::vector<FrontEdge> front_;
  Eigen::Vector3d low_, high_;
  std::optional<TriangleTree> tree_;  ///< of a sheet
};

}  // namespace brainshift::solve
