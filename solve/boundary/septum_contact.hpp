// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solve/boundary/pushed_nodes.hpp"
#include "solve/boundary/sheet_walls.hpp"

namespace brainshift::solve {

/// Frictionless contact of tissue on both sides of a fixed rigid sheet, with finite sliding and separation. A node
/// knows from the start on which side it lies. After a step every node behind its wall is put back along the wall's
/// normal, see PushedNodes; one that has slid beyond the sheet's rim is free. Towards the rim less of the gap is put
/// back, and nothing at the rim: METHOD.md, section 14.
class SeptumContact {
 public:
  /// nodes: those that may touch; of those farther away at the start than `reach`, mm, or beyond the rim nothing is
  /// asked. positions (n × 3) of all nodes, mm; rows: shape functions at all of them.
  SeptumContact(const Surface& sheet, const Points& positions, std::span<const std::int32_t> nodes, double reach,
                const ShapeRows& rows);

  /// Nodes know their sides as at the start again.
  void begin_anew() { panel_ = first_panel_; }

  /// Sets the nodal masses (one a node) that weigh the pushes.
  void weigh(std::span<const double> mass) { nodes_.weigh(mass); }

  /// Puts nodes behind their wall back.
  void apply(NodalVectors& parameters);

  /// Work of the pushes of the last apply(), see PushedNodes::work().
  double push_work(const NodalVectors& before, const NodalVectors& after) const { return nodes_.work(before, after); }

  struct Measures {
    std::size_t touching = 0;        ///< nodes within a hundredth of a millimetre of their wall, or behind it
    double largest_penetration = 0;  ///< mm behind the wall
  };
  Measures measure(const NodalVectors& parameters) const;

 private:
  using Edge = std::array<Eigen::Vector3d, 2>;

  std::optional<SheetWalls::Foot> faded_foot(std::size_t i, const NodalVectors& parameters, std::int32_t& panel) const;
  void sweep(NodalVectors& parameters);

  SheetWalls walls_;
  std::vector<std::int32_t> first_panel_, panel_;  ///< of each node, at the start and where it was last
  PushedNodes nodes_;
  double fade_;                              ///< mm from the rim
  std::vector<std::vector<Edge>> near_rim_;  ///< of each node, within three times the reach
};

}  // namespace brainshift::solve
