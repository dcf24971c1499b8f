// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

#include "solve/arrays/nodal_vectors.hpp"
#include "solve/boundary/face_gaps.hpp"
#include "solve/interface/result.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Two nodes at one place of a cut, a thousandth of the spacing off it: one on each face.
struct FacePair {
  std::int32_t above;  ///< on the side of the normal
  std::int32_t below;
  Eigen::Vector3d place;   ///< mm
  Eigen::Vector3d normal;  ///< of the cut, a unit vector
};

/// A node on the wall of a cavity.
struct WallNode {
  std::int32_t node;
  Eigen::Vector3d normal;  ///< of the wall, into the tissue, a unit vector
};

/// Frictionless contact, with finite sliding and separation, between the faces of cuts, or of the wall
/// of a cavity with itself. After a step each face node
/// that overlaps the opposite face, and the nodes of that face about it, are parted by equal and opposite pushes along
/// the normal:
///   û ← û + M⁻¹ Vᵀ Gᵀ λ,  λ ≥ 0,  gap + G W Gᵀ λ ≥ 0,  W = V M⁻¹ Vᵀ,
/// V the shape functions at the face nodes and G their shares in the gaps. Sweeps of λ ← max(0, λ − p D⁻¹ gap), D the
/// row sums of |G||W||G|ᵀ and p the opposite face's presence, come near to it; what remains of an overlap is taken back
/// in the following steps.
class FaceContact {
 public:
  /// positions (n × 3), mm, and spacing, mm, of all nodes; rows: shape functions at their positions.
  FaceContact(std::span<const FacePair> pairs, const Points& positions, std::span<const double> spacing,
              const ShapeRows& rows);
  FaceContact(std::span<const WallNode> wall, const Points& positions, std::span<const double> spacing,
              const ShapeRows& rows);

  /// Sets the nodal masses (one a node) that weigh the pushes.
  void weigh(std::span<const double> mass);

  /// Parts faces that overlap.
  void apply(NodalVectors& parameters);

  FaceMeasures measure(const NodalVectors& parameters) const;

 private:
  FaceContact(std::span<const std::int32_t> nodes, FaceGaps gaps, const ShapeRows& rows, Eigen::Index all);

  using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  Points places(const NodalVectors& parameters) const;
  void find_overlaps();
  void lump();
  void sweep();
  void shift(NodalVectors& parameters) const;

  RowMatrix shape_;  ///< V
  FaceGaps gaps_;
  Eigen::VectorXd inverse_mass_;  ///< one a node of the cloud
  RowMatrix softness_;            ///< W

  // of apply(): links of the face nodes that overlap, else one value a face node
  std::vector<FaceGaps::Link> links_;
  Eigen::VectorXd row_sum_;  ///< D; 0 where nothing overlaps
  Eigen::VectorXd push_;     ///< λ
  Eigen::VectorXd gap_;
  Points force_, shift_;  ///< Gᵀ λ and W Gᵀ λ
};

}  // namespace brainshift::solve
