// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "discretise/interface/node_cloud.hpp"
#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// What makes prescribed displacements give way: they were measured with noise. The state is the minimum of
///   W(u) − work of the forces + (s/2) rᵀ C⁻¹ r,  r = u − what is prescribed,  C = E diag(σ²) Eᵀ,
/// with E the share of each measured point in what is prescribed at a node: noise there is noise here, as far as the
/// displacement was extended. Nodes without a share are held exactly. exp(−W/s) is the prior of the deformation.
struct Measurement {
  Eigen::SparseMatrix<double> spread;         ///< E, (nodes × measured points of the cortex)
  Points sigma = Points(0, 3);                ///< of these points, mm, > 0
  Points inner = Points(0, 3);                ///< measured points inside the body, undeformed, mm
  Points inner_displacement = Points(0, 3);   ///< mm
  Points inner_sigma = Points(0, 3);          ///< mm, > 0
  Points cortex = Points(0, 3);               ///< the points of the cortex, undeformed, mm
  Points cortex_displacement = Points(0, 3);  ///< as measured there, before it was extended, mm
  /// What other displacements of these points (m × 3) prescribe at the nodes (n × 3), mm, NaN where nothing is. None:
  /// E carries what is changed.
  std::function<Points(const Points&)> extend = {};
  double weight = 0;                  ///< s, mJ; 0: chosen by choose_weight()
  bool registration_unknown = false;  ///< what was measured may hold a rigid motion of the patient against the image
  Points asked = Points(0, 3);        ///< undeformed places whose spread is wanted, mm
};

/// What is prescribed at the nodes of a cloud, one row a node in its order.
struct Conditions {
  /// (n × 3) mm, NaN: that component is free. No rows when nothing is prescribed.
  Points displacement = Points(0, 3);
  /// (n × 3) N, acts at the node. No rows when there is none.
  Points force = Points(0, 3);
  /// Of what is prescribed; absent: it is held exactly.
  std::optional<Measurement> measured = {};
  /// Displacements are held at the nodes themselves, at the rim of a patch, too (PatchRim): for a cloud that was
  /// thinned and whose outermost nodes of a patch lie inside it.
  bool at_nodes_alone = false;

  /// Whether a component of a node's displacement is prescribed; axis 0, 1 or 2.
  bool is_prescribed(Eigen::Index node, int axis) const;
  /// Whether any component is.
  bool is_prescribed(Eigen::Index node) const;
  /// Whether all components are.
  bool is_held(Eigen::Index node) const;
  /// Whether a force other than 0 acts at a node.
  bool is_pushed(Eigen::Index node) const;
};

/// Throws std::invalid_argument, naming the node, where there is not one row a node, a displacement is infinite or a
/// force not finite.
void check_conditions(const Conditions& conditions, std::size_t nodes);

/// Nodes, ascending, with a prescribed component.
std::vector<std::int32_t> prescribed_nodes(const Conditions& conditions);

/// How many nodes have a prescribed displacement or a force.
std::size_t count_loaded(const Conditions& conditions);

/// The conditions at some of the nodes, in their order.
Conditions subset(const Conditions& conditions, const std::vector<std::int32_t>& nodes);

/// The point arrays `prescribed_displacement` (mm, NaN where free) and `force` (N) of a nodes.vtu; none where there are
/// none. Throws std::invalid_argument, naming file and node, on an array of the wrong size, an infinite displacement or
/// a force that is not finite.
Conditions read_conditions(const std::filesystem::path& file);

/// nodes.vtu with both arrays, those without rows aside. Throws std::runtime_error, naming the file.
void write_nodes(const std::filesystem::path& file, const NodeCloud& cloud, const Conditions& conditions);

}  // namespace brainshift::solve
