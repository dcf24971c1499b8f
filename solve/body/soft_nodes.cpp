// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/soft_nodes.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

#include "solve/material/material.hpp"
#include "solve/shape/moving_least_squares.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

namespace {

constexpr double least_share = 0.2;     // of a node, for it to move with a tissue
constexpr double largest_growth = 1.7;  // of supports without hidden nodes; from 1.6 on MMLS uses its penalty

std::vector<double> distinct(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  return sorted;
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

  bool all_of(std::span<const std::int32_t> support) const {
    return std::ranges::all_of(support, [&](std::int32_t a) { return is_seen[static_cast<std::size_t>(a)] != 0; });
  }
};

/// The places of a modulus whose support has hidden nodes.
std::vector<std::int32_t> places_to_change(const SeenNodes& seen, std::span<const double> modulus, double of,
                                           const ShapeRows& rows) {
  std::vector<std::int32_t> places;
  for (std::size_t p = 0; p < rows.size(); ++p) {
    if (modulus[p] == of && !seen.all_of(rows[p].node)) {
      places.push_back(static_cast<std::int32_t>(p));
    }
  }
  return places;
}

/// The rows of these places anew, from the nodes seen alone; empty where these do not suffice.
ShapeRows rows_of_seen(const MixedCloud& cloud, const SeenNodes& seen, const Points& places, bool with_derivatives) {
  std::vector<double> spacing;
  for (const std::int32_t a : seen.nodes) {
    spacing.push_back(cloud.spacing[static_cast<std::size_t>(a)]);
  }
  const ShapeFunctions shape(cloud.positions(seen.nodes, Eigen::all), spacing, cloud.options, cloud.visibility);
  ShapeRows rows = shape.evaluate_where_admissible(places, with_derivatives, largest_growth);
  for (std::int32_t& node : rows.node) {
    node = seen.nodes[static_cast<std::size_t>(node)];
  }
  return rows;
}

/// Replaces these rows by those that are not empty. Returns how many.
std::size_t replace(std::span<const std::int32_t> which, const ShapeRows& made, ShapeRows& rows) {
  std::vector<std::int32_t> replaced, made_there;
  for (std::size_t k = 0; k < which.size(); ++k) {
    if (made[k].size() > 0) {
      replaced.push_back(which[k]);
      made_there.push_back(static_cast<std::int32_t>(k));
    }
  }
  if (replaced.empty()) {
    return 0;
  }
  const std::size_t grown = std::max(rows.grown, made.grown);  // the rows that go may have grown, too
  rows = with_rows(rows, replaced, rows_at(made, made_there));
  rows.grown = grown;
  return replaced.size();
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
  if (cloud.options.basis == Basis::quadratic) {
    return 0;
  }
  const auto least = static_cast<std::size_t>(monomial_count(cloud.options.planar ? 2 : 3, 1));
  std::size_t changed = 0;
  for (const double of : distinct(modulus)) {
    const SeenNodes seen(cloud.modulus, of);
    const std::vector<std::int32_t> which = places_to_change(seen, modulus, of, rows);
    if (!which.empty() && seen.nodes.size() >= least) {
      changed += replace(which, rows_of_seen(cloud, seen, places(which, Eigen::all), !rows.derivative.empty()), rows);
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
