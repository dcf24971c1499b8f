// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "segmentation/geometry/signed_distance.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/boundary/pushed_nodes.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Frictionless finite sliding of surface nodes inside a rigid skull, with separation. After a step every node outside
/// is put back along the skull's normal, see PushedNodes. A node that starts outside (the surfaces' own inaccuracy) may
/// stay that far out.
class Contact {
 public:
  /// nodes: those that may touch. rows: shape functions at all nodes' positions.
  Contact(SignedDistance skull, const Points& positions, std::span<const std::int32_t> nodes, const ShapeRows& rows);
  /// The same with a distance that others use too.
  Contact(std::shared_ptr<const SignedDistance> skull, const Points& positions, std::span<const std::int32_t> nodes,
          const ShapeRows& rows);

  /// Sets the nodal masses (one a node) that weigh the correction.
  void weigh(std::span<const double> mass) { nodes_.weigh(mass); }

  /// Puts penetrating nodes back.
  void apply(NodalVectors& parameters);

  /// Work of the pushes of the last apply(), see PushedNodes::work().
  double push_work(const NodalVectors& before, const NodalVectors& after) const { return nodes_.work(before, after); }

  struct Measures {
    std::size_t touching = 0;        ///< nodes within a hundredth of a millimetre of the skull or outside it
    double largest_penetration = 0;  ///< mm further outside the skull than at the start
    bool lost = false;               ///< a node is so far outside that nothing pushes it back
  };
  Measures measure(const NodalVectors& parameters) const;

  const std::shared_ptr<const SignedDistance>& skull() const { return skull_; }
  const PushedNodes& nodes() const { return nodes_; }
  /// mm outside the skull at the start, one a node that may touch.
  std::span<const double> allowed() const { return allowed_; }

 private:
  std::shared_ptr<const SignedDistance> skull_;
  PushedNodes nodes_;
  std::vector<double> allowed_;  ///< mm outside the skull at the start, one a contact node
};

}  // namespace brainshift::solve
