// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/node_supports.hpp"

namespace brainshift::solve {

double dilatation(const ShapeOptions& options) {
  if (options.dilatation > 0) {
    return options.dilatation;
  }
  if (options.planar) {
    return options.basis == Basis::linear ? 1.8 : 2.4;
  }
  return options.basis == Basis::linear ? 1.6 : 2.2;
}

std::vector<double> support_radii(std::span<const double> spacing, const ShapeOptions& options) {
  std::vector<double> radius(spacing.begin(), spacing.end());
  for (double& r : radius) {
    r *= dilatation(options);
  }
  return radius;
}

NodeSupports::NodeSupports(const Points& p, std::span<const double> spacing, const ShapeOptions& o,
                           std::shared_ptr<const Visibility> v)
    : positions(p), options(o), search(positions, support_radii(spacing, o)), visibility(std::move(v)) {}

}  // namespace brainshift::solve
