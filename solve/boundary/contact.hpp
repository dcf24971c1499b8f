// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "segmentation/geometry/signed_distance.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Frictionless finite sliding of surface nodes inside a rigid skull, with separation. After a step every node outside
/// is put back along the skull's normal: like the simplified EBCIEM, û ← û + M⁻¹Vᵀ D⁻¹ δ with D the row sums of |V| M⁻¹
/// |V|ᵀ. What remains is put back in the following steps, so at rest the penetration is a small part of the last step's
/// motion. A node that starts outside (the surfaces' own inaccuracy) may stay that far out.
class Contact {
 public:
  /// nodes: those that may touch. rows: shape functions at all nodes' positions.
  Contact(SignedDistance skull, const Points& positions, std::vector<std::int32_t> nodes, const ShapeRows& rows);

  /// Sets the nodal masses (one a node) that weigh the correction.
  void weigh(std::span<const double> mass);

  /// Puts penetrating nodes back.
  void apply(NodalVectors& parameters);

  /// Work of the pushes of the last apply(), times α: half their sum over the way from one step before the state that
  /// they were applied to, to one after. Negative: they brake.
  double push_work(const NodalVectors& before, const NodalVectors& after) const;

  struct Measures {
    std::size_t touching = 0;        ///< nodes within a hundredth of a millimetre of the skull or outside it
    double largest_penetration = 0;  ///< mm further outside the skull than at the start
    bool lost = false;               ///< a node is so far outside that nothing pushes it back
  };
  Measures measure(const NodalVectors& parameters) const;

  const SignedDistance& skull() const { return skull_; }

 private:
  Eigen::Vector3d place(std::size_t i, const NodalVectors& parameters) const;

  SignedDistance skull_;
  Points positions_;                 ///< of the contact nodes
  std::vector<std::int64_t> begin_;  ///< V, compressed rows
  std::vector<std::int32_t> node_;
  std::vector<double> shape_;
  std::vector<double> allowed_;          ///< mm outside the skull at the start, one a contact node
  std::vector<double> inverse_mass_;     ///< one a node of the cloud
  std::vector<double> inverse_row_sum_;  ///< D⁻¹
  std::vector<double> correction_;       ///< 3 a contact node, scratch of apply()
};

}  // namespace brainshift::solve
