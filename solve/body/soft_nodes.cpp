// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/soft_nodes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

#include "solve/material/material.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

namespace {

constexpr double least_share = 0.2;   // of a node, for it to move with a tissue
constexpr double least_spread = 0.3;  // of nodes about their middle, in spacings, in any direction
constexpr std::size_t enough_in_space = 8, enough_in_plane = 6;

std::vector<double> distinct(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  return sorted;
}

/// Whether shape functions of these nodes need no others. The quadratic basis needs too many.
bool can_support(const MixedCloud& cloud, std::span<const std::int32_t> nodes) {
  const bool planar = cloud.options.planar;
  if (cloud.options.basis == Basis::quadratic || nodes.size() < (planar ? enough_in_plane : enough_in_space)) {
    return false;
  }
  Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
  double spacing = 0;
  for (const std::int32_t a : nodes) {
    middle += cloud.positions.row(a) / static_cast<double>(nodes.size());
    spacing += cloud.spacing[static_cast<std::size_t>(a)] / static_cast<double>(nodes.size());
  }
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const std::int32_t a : nodes) {
    const Eigen::RowVector3d away = cloud.positions.row(a) - middle;
    moments += away.transpose() * away / static_cast<double>(nodes.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(moments, Eigen::EigenvaluesOnly);
  const double least = least_spread * spacing;
  return eigen.eigenvalues()[planar ? 1 : 0] >= least * least;
}

/// The nodes that tissue of a modulus sees.
struct SeenNodes {
  std::vector<std::int32_t> nodes;
  std::vector<char> is_seen;  ///< one for each of all nodes

  SeenNodes(std::span<const double> node_modulus, double modulus) : is_seen(node_modulus.size(), 0) {
    for (std::size_t a = 0; a < node_modulus.size(); ++a) {
      if (!much_stiffer(modulus, node_modulus[a])) {
        is_seen[a] = 1;
        nodes.push_back(static_cast<std::int32_t>(a));
      }
    }
  }

  std::vector<std::int32_t> of(std::span<const std::int32_t> support) const {
    std::vector<std::int32_t> seen;
    std::ranges::copy_if(support, std::back_inserter(seen),
                         [&](std::int32_t a) { return is_seen[static_cast<std::size_t>(a)] != 0; });
    return seen;
  }
};

/// The places of a modulus whose support has hidden nodes and can do without.
std::vector<std::int32_t> places_to_change(const MixedCloud& cloud, const SeenNodes& seen,
                                           std::span<const double> modulus, double of, const ShapeRows& rows) {
  std::vector<std::int32_t> places;
  for (std::size_t p = 0; p < rows.size(); ++p) {
    if (modulus[p] == of) {
      const std::vector<std::int32_t> left = seen.of(rows[p].node);
      if (left.size() < rows[p].size() && can_support(cloud, left)) {
        places.push_back(static_cast<std::int32_t>(p));
      }
    }
  }
  return places;
}

/// The rows of these places anew, from the nodes seen alone.
ShapeRows rows_of_seen(const MixedCloud& cloud, const SeenNodes& seen, const Points& places, bool with_derivatives) {
  std::vector<double> spacing;
  for (const std::int32_t a : seen.nodes) {
    spacing.push_back(cloud.spacing[static_cast<std::size_t>(a)]);
  }
  const ShapeFunctions shape(cloud.positions(seen.nodes, Eigen::all), spacing, cloud.options, cloud.visibility);
  ShapeRows rows = shape.evaluate(places, with_derivatives);
  for (std::int32_t& node : rows.node) {
    node = seen.nodes[static_cast<std::size_t>(node)];
  }
  return rows;
}

/// Of the stiffest that, with all that is stiffer, has its share. share: of each modulus, ascending.
double modulus_of(std::span<const double> share, std::span<const double> moduli) {
  const double least = least_share * std::reduce(share.begin(), share.end());
  double modulus = std::numeric_limits<double>::infinity(), stiffer = 0;
  for (std::size_t m = moduli.size(); m-- > 0 && stiffer < least;) {
    stiffer += share[m];
    modulus = moduli[m];
  }
  return modulus;
}

}  // namespace

std::vector<double> moduli_at_nodes(std::span<const double> volume, std::span<const double> modulus,
                                    const ShapeRows& rows, std::size_t nodes) {
  const std::vector<double> moduli = distinct(modulus);
  std::vector<double> share(nodes * moduli.size(), 0.0);  // of each node by modulus
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const auto column = static_cast<std::size_t>(std::ranges::lower_bound(moduli, modulus[p]) - moduli.begin());
    const ShapeRow row = rows[p];
    for (std::size_t k = 0; k < row.size(); ++k) {
      share[static_cast<std::size_t>(row.node[k]) * moduli.size() + column] += volume[p] * row.value[k] * row.value[k];
    }
  }
  std::vector<double> result;
  for (std::size_t a = 0; a < nodes; ++a) {
    result.push_back(modulus_of(std::span(share).subspan(a * moduli.size(), moduli.size()), moduli));
  }
  return result;
}

std::size_t hide_soft_nodes(const MixedCloud& cloud, const Points& places, std::span<const double> modulus,
                            ShapeRows& rows) {
  std::size_t changed = 0;
  for (const double of : distinct(modulus)) {
    const SeenNodes seen(cloud.modulus, of);
    const std::vector<std::int32_t> which = places_to_change(cloud, seen, modulus, of, rows);
    if (!which.empty()) {
      const ShapeRows made = rows_of_seen(cloud, seen, places(which, Eigen::all), !rows.derivative.empty());
      const std::size_t grown = std::max(rows.grown, made.grown);  // the rows that go may have grown, too
      rows = with_rows(rows, which, made);
      rows.grown = grown;
      changed += which.size();
    }
  }
  return changed;
}

ShapeRows rows_at_rim(const MixedCloud& cloud, const PatchRim& rim) {
  if (rim.node.empty()) {
    return {};
  }
  const ShapeFunctions shape(cloud.positions, cloud.spacing, cloud.options, cloud.visibility);
  ShapeRows rows = shape.evaluate(rim.places, false);
  if (!cloud.modulus.empty()) {
    std::vector<double> modulus;
    for (const std::int32_t a : rim.node) {
      modulus.push_back(cloud.modulus[static_cast<std::size_t>(a)]);
    }
    hide_soft_nodes(cloud, rim.places, modulus, rows);
  }
  return rows;
}

}  // namespace brainshift::solve
