// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"

namespace brainshift::solve {

/// The columns span what a matrix of inertia has of independent directions, and are orthonormal in it.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& inertia);

/// The second level of a two-level preconditioner (Tang, Nabben, Vuik & Erlangga 2009) for a body that little holds, as
/// a brain in fluid, which rocks about its opening. Its space W has the six rigid motions, each faded to zero where
/// essential conditions hold, once over a short and once over a long distance, and those of each stiff part that soft
/// tissue holds alone. The masses M of a step become those of
///   P = M⁻¹ + W C Wᵀ,
/// where C gives the motions in W that have a lower eigenvalue of P K than `quick` this one. No other eigenvalue of the
/// tissue's grows by more than `quick`, and the state at rest stays the same.
class RigidModes {
 public:
  /// A_0 of a brain that lies in its skull.
  static constexpr double quick = 1e-3;

  static constexpr std::size_t most_parts = 4;

  /// Of W: a row for each motion and fade, then for each motion of each part. Motions are in mm, rotations those of the
  /// outermost node of the body or the part.
  static constexpr int most_motions = 12 + 6 * static_cast<int>(most_parts);
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_motions, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_motions, most_motions>;

  /// positions (n × 3) of the nodes, mm; held: those that W does not move. Without any the fades are one. parts: nodes
  /// of each stiff part, none of them held and each in one part; of more than most_parts the first count.
  RigidModes(const Points& positions, std::span<const std::int32_t> held,
             std::span<const std::vector<std::int32_t>> parts = {});

  /// Rows of W.
  Eigen::Index motions() const { return motions_; }

  /// Wᵀ K W of a resistance, µN/mm, from its differences over `amplitude`, mm. resistance: forces (µN) where the nodes
  /// have moved by these parameters (mm) from where they are. It is asked for none last.
  using Resistance = std::function<const NodalVectors&(const NodalVectors& moved)>;
  Matrix stiffness(const Resistance& resistance, double amplitude) const;

  /// Makes C for masses, one a node, from Wᵀ K W of the tissue and of what it touches, which bounds C.
  void weigh(std::span<const double> mass, const Matrix& tissue, const Matrix& contact);

  /// û⁺ ← û⁺ + W C Wᵀ M a, with a = û⁺ − û − β(û − û⁻) of a step in the masses M, its contact and conditions included.
  void add(std::span<const double> mass, double beta, const NodalVectors& now, const NodalVectors& before,
           NodalVectors& next) const;

  /// (x − y)ᵀ (M − P⁻¹) (x − y).
  double less_inertia(std::span<const double> mass, const NodalVectors& x, const NodalVectors& y) const;

  /// v ← M⁻¹ P⁻¹ v.
  void lighten(std::span<const double> mass, NodalVectors& v) const;

  /// Of the body, mm.
  double radius() const { return radius_; }

 private:
  struct Node {
    Eigen::Vector3d arm;                                ///< from the middle of the body, over its radius
    Eigen::Vector2d fade;                               ///< short, long
    Eigen::Index part = 0;                              ///< row of W that its part's motions begin at; 0: it is in none
    Eigen::Vector3d in_part = Eigen::Vector3d::Zero();  ///< from the middle of the part, over the part's radius
  };
  void add_part(const Points& positions, const std::vector<std::int32_t>& nodes);
  Eigen::Vector3d motion(std::size_t node, const Vector& weights) const;
  Matrix inertia(std::span<const double> mass) const;  ///< Wᵀ M W
  Vector moments(std::size_t node, const Eigen::Vector3d& force) const;
  template <class Force>
  Vector moments_of(const Force& force) const;

  std::vector<Node> nodes_;
  double radius_ = 0;
  Eigen::Index motions_ = 12;
  Matrix gain_;  ///< C
  Matrix less_;  ///< P⁻¹ = M − M W less Wᵀ M
};

}  // namespace brainshift::solve
