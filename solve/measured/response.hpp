// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solve/body/body_parts.hpp"

namespace brainshift::solve {

/// How points of a body answer small forces on each other: G, (3m × 3m), mm/µN, with x, y and z of the first point
/// first.
struct Response {
  Eigen::MatrixXd compliance;
  /// (3m × 6) rigid motions of the points where nothing holds the body: then G is that of forces in balance, and moves
  /// the body as a whole by nothing. (3m × 0) where it is held.
  Eigen::MatrixXd rigid;
  bool free = false;  ///< nothing holds the body
  /// (k × 3) places that a smooth motion of the opening is told at, mm; none: there is no such motion.
  Points sites = Points(0, 3);
  /// (k) what is left there of a motion that fades towards the rim of the opening; none: no motion fades.
  Eigen::VectorXd fading = {};
  /// (3m × 3k) what becomes of it at the points.
  Eigen::MatrixXd carry = {};
  double shortest = 0;  ///< mm over which that motion is alike at least; over less it would be each point's own
};

/// The six rigid motions at places, (3m × 6): moves along x, y, z by 1 mm, then turns about them through the centre of
/// `about` by 1 mm a mean distance from it.
Eigen::MatrixXd rigid_motions(const Points& places, const Points& about);

/// Whether a measured point has a share in what is prescribed at a node.
bool is_measured(const Conditions& conditions, Eigen::Index node);

/// What a body of some hundred nodes answers forces by.
struct StiffBody {
  NodeCloud cloud;
  Eigen::MatrixXd stiffness;  ///< K of the undeformed body, its patches' pressures constant, nothing held, (3n × 3n)
  /// The surface is held along its normal where nothing is prescribed, as a skull around it would.
  bool touches = false;
};

/// Assembled whole: for clouds of some hundred nodes. touches: as StiffBody has it.
StiffBody stiff_body(const BodyParts& parts, bool touches);

/// G = Φ K⁻¹ Φᵀ. at_points: shape functions at the points. Prescribed nodes that no measured point has a share in are
/// held. Where more of the surface is prescribed than free, it is not held along its normals: the rest would hardly
/// resist a rigid motion. conditions: at the body's nodes.
Response linear_response(const StiffBody& body, const Conditions& conditions, const ShapeRows& at_points);

/// How the motion of the opening is carried into the same body.
struct Carried {
  std::vector<Eigen::Index> nodes;  ///< whose displacement is measured
  Eigen::MatrixXd motion;           ///< (3m × 3 nodes) at the points, of 1 mm of each component of these nodes
};

/// Where the displacement of the measured nodes is held: not their parameters, as a coarse cloud's displacement is a
/// mean of these over some nodes. at_nodes: shape functions at the body's nodes; others as of linear_response().
Carried carried_motion(const StiffBody& body, const Conditions& conditions, const ShapeRows& at_nodes,
                       const ShapeRows& at_points);

}  // namespace brainshift::solve
