// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/boundary/contact.hpp"
#include "solve/boundary/essential_conditions.hpp"
#include "solve/boundary/external_force.hpp"
#include "solve/boundary/face_contact.hpp"
#include "solve/boundary/septum_contact.hpp"
#include "solve/force/point_blocks.hpp"
#include "solve/force/point_laws.hpp"
#include "solve/interface/cut.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Where the integration points lie, in the order of the blocks.
struct PlacedPoints {
  Points position;                   ///< mm
  std::vector<std::int32_t> tissue;  ///< label
};

/// A body as time stepping moves it: points and laws that resist, conditions that hold, forces that push. Its nodes are
/// along a space-filling curve. What it was made from is gone.
struct Body {
  std::vector<std::int32_t> original;  ///< the cloud's node of each
  Points positions;                    ///< undeformed nodes, mm, in the cloud's own order
  std::vector<double> spacing;         ///< at the nodes, mm, in the cloud's own order
  CutFacets cut;                       ///< that parts it; none: empty
  ShapeRows nodal_rows;                ///< at the nodes' own positions, without derivatives
  PointBlocks points;
  PlacedPoints placed;                                      ///< for the sentence about a failure
  std::vector<std::vector<std::int32_t>> stiff_parts = {};  ///< nodes of each; see stiff_parts()
  std::vector<double> node_modulus = {};                    ///< moduli_at_nodes(), Pa; none: all see each other
  PointLaws laws;
  std::vector<std::vector<PronyTerm>> prony;  ///< of a transient run: one list a row of the laws, or none
  std::vector<double> mass;                   ///< of a transient run: physical, g
  EssentialConditions essential;
  std::optional<Contact> contact;
  std::optional<FaceContact> face_contact;
  std::optional<FaceContact> wall_contact;  ///< of a cavity
  std::optional<SeptumContact> septum_contact;
  ExternalForce external;

  std::size_t nodes() const { return original.size(); }

  bool may_touch() const { return contact || face_contact || wall_contact || septum_contact; }

  /// Puts what is beyond the skull, another face of a cut, the other side of a cavity or a septum back.
  void touch(NodalVectors& parameters) {
    if (contact) {
      contact->apply(parameters);
    }
    if (face_contact) {
      face_contact->apply(parameters);
    }
    if (wall_contact) {
      wall_contact->apply(parameters);
    }
    if (septum_contact) {
      septum_contact->apply(parameters);
    }
  }
};

}  // namespace brainshift::solve
