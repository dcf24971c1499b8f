// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
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

/// Which faces may meet: the two sides of cuts, or any parts of the wall of a cavity.
enum class Faces : std::uint8_t { of_cuts, of_cavity };

/// How far faces are apart as they move. Of cuts face node 2i lies above place i, 2i + 1 below it; of a cavity face
/// node i lies at place i, whose normal points into the tissue. Its gap is that to the opposite face: a mean over the
/// nodes b there that are within reach of where it is now, of (x − x_b)·n, n between the outward normal at b and the
/// inward one at x, which vanishes to third order where curved faces touch; less what it was undeformed, of a cavity
/// only where that was an overlap. Nodes count by how near they are, how much they face x and how little the face is
/// folded there, so that the gap changes smoothly. In a cavity nodes are opposite that face each other, and did so
/// undeformed, through the cavity and not through tissue. They are looked for anew when some node may have come within
/// reach.
class FaceGaps {
 public:
  /// undeformed: the face nodes, mm, two a place of cuts, one of a cavity.
  FaceGaps(std::vector<FacePlace> places, Points undeformed, Faces kind = Faces::of_cuts);

  /// Takes the face nodes to where they are now, mm.
  void move(Points now);

  const Points& undeformed() const { return undeformed_; }
  const Eigen::VectorXd& gaps() const { return gap_; }  ///< mm; negative: overlap; infinite: nothing is opposite
  /// How much of the opposite face is there, 0 to 1: little where it is hardly within reach, turned away or folded.
  double presence(Eigen::Index face) const { return presence_[face]; }
  double spacing(Eigen::Index face) const { return at(face / sides_).spacing; }

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
  void append_neighbours(const FacePlace& place, std::span<const std::int32_t> near);
  Eigen::Vector3d outward_normal(Eigen::Index face) const;
  Eigen::Index nearest_place(Eigen::Index face) const;
  bool met_through_cavity(Eigen::Index face, Eigen::Index other) const;
  bool has_come_near() const;
  void look_for_opposite();
  double mean_gap(Eigen::Index face);
  template <class Visit>
  void visit_opposite(Eigen::Index face, const Visit& visit) const;

  Faces kind_;
  Eigen::Index sides_;  ///< face nodes a place
  std::vector<FacePlace> places_;
  std::vector<Neighbour> neighbours_;  ///< of each place in turn
  std::vector<std::size_t> begin_;
  Points undeformed_, now_, normal_;  ///< of the face nodes
  Eigen::VectorXd undeformed_gap_, gap_, presence_;
  Points looked_at_ = Points(0, 3);  ///< of a cavity: where the face nodes were when others were looked for
  std::vector<std::vector<std::int32_t>> opposite_;  ///< that were found, of each face node
};

}  // namespace brainshift::solve
