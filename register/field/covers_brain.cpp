// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/covers_brain.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "register/field/nearest_node.hpp"

namespace brainshift::registration {

namespace {

constexpr double spacings_apart = 2;

[[noreturn]] void not_of_this_brain(double share, const std::string& what) {
  throw std::invalid_argument("the solution is not of this brain: " + std::to_string(std::lround(100 * share)) +
                              " % of " + what + "; its nodes must fill the undeformed brain, in mm, LPS");
}

/// Of the surface's vertices. Tissue that was taken out may leave much of the inside without nodes, but little of it.
double share_without_nodes(const RegisterInput& input, const BrainZones& zones) {
  const PointTree nodes(input.solution.positions);
  double seen = 0, without = 0;
  for (Eigen::Index v = 0; v < input.brain.vertices.rows(); ++v) {
    const Eigen::Vector3d x = input.brain.vertices.row(v);
    if (zones.wall && zones.wall->value(x) < 0) {
      continue;
    }
    ++seen;
    without += spacings_to_node(nodes, input.solution, x) > spacings_apart ? 1 : 0;
  }
  return seen > 0 ? without / seen : 0;
}

double share_outside(const Solution& solution, const BrainZones& zones) {
  double outside = 0;
  for (Eigen::Index a = 0; a < solution.positions.rows(); ++a) {
    const double far = spacings_apart * solution.spacing[static_cast<std::size_t>(a)];
    outside += zones.outside.value(solution.positions.row(a).transpose()) > far ? 1 : 0;
  }
  return outside / static_cast<double>(solution.positions.rows());
}

}  // namespace

void check_covers(const RegisterInput& input, const BrainZones& zones) {
  constexpr double much_of_surface = 0.2, much_of_nodes = 0.05;  // ours: next to none
  if (const double share = share_without_nodes(input, zones); share > much_of_surface) {
    not_of_this_brain(share, "its surface lies over two spacings from every node");
  }
  if (const double share = share_outside(input.solution, zones); share > much_of_nodes) {
    not_of_this_brain(share, "the nodes lie over two spacings outside it");
  }
}

}  // namespace brainshift::registration
