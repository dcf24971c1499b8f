// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// A place of a cut where each of its faces has a node, undeformed.
struct FacePlace {
  Eigen::Vector3d place;   ///< mm
  Eigen::Vector3d normal;  ///< of the cut, a unit vector
  double spacing;          ///< of the nodes there, mm
};

/// How far the two faces of cuts are apart as they move. Face node 2i lies above place i, 2i + 1 below it. Its gap is
/// that to the opposite face: a mean over the nodes b there that are within reach of where it is now, of (x − x_b)·n, n
/// between the outward normal at b and the inward one at x, which vanishes to third order where curved faces touch;
/// less what it was undeformed.
class FaceGaps {
 public:
  /// undeformed (2 places × 3): the face nodes, mm.
  FaceGaps(std::vector<FacePlace> places, Points undeformed);

  /// Takes the face nodes to where they are now (2 places × 3), mm.
  void move(Points now);

  const Points& undeformed() const { return undeformed_; }
  const Eigen::VectorXd& gaps() const { return gap_; }  ///< mm; negative: overlap; infinite: nothing is opposite
  double spacing(Eigen::Index face) const { return at(face / 2).spacing; }

  /// A node of the opposite face, its share of the mean, and the direction that parts the two, out of it.
  struct Link {
    Eigen::Index face, opposite;
    double share;
    Eigen::Vector3d direction;
  };
  void append_links(Eigen::Index face, std::vector<Link>& links) const;

 private:
  /// Of the same cut, and its weight in the gradient of the displacement along the face, 1/mm.
  struct Neighbour {
    Eigen::Index place;
    Eigen::Vector3d weight;
  };
  const FacePlace& at(Eigen::Index place) const { return places_[static_cast<std::size_t>(place)]; }
  std::span<const Neighbour> neighbours(Eigen::Index place) const;
  void append_neighbours(const FacePlace& place);
  Eigen::Vector3d outward_normal(Eigen::Index face) const;
  Eigen::Index nearest_place(Eigen::Index face) const;
  double mean_gap(Eigen::Index face) const;
  template <class Visit>
  void visit_opposite(Eigen::Index face, const Visit& visit) const;

  std::vector<FacePlace> places_;
  std::vector<Neighbour> neighbours_;  ///< of each place in turn
  std::vector<std::size_t> begin_;
  Points undeformed_, now_, normal_;  ///< of the face nodes
  Eigen::VectorXd undeformed_gap_, gap_;
};

}  // namespace brainshift::solve
