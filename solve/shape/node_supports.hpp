// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "segmentation/geometry/points.hpp"
#include "solve/interface/shape_options.hpp"
#include "solve/shape/support_search.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

/// What the shape functions of a cloud are evaluated from: where its nodes lie, how far their supports reach, and the
/// cut that hides some from others.
struct NodeSupports {
  Points positions;
  ShapeOptions options;
  SupportSearch search;
  std::shared_ptr<const Visibility> visibility;

  NodeSupports(const Points& p, std::span<const double> spacing, const ShapeOptions& o,
               std::shared_ptr<const Visibility> v);
};

/// Support radius / local spacing that the options stand for: as given, else the basis's default.
double dilatation(const ShapeOptions& options);

/// The radius of each node's support, mm.
std::vector<double> support_radii(std::span<const double> spacing, const ShapeOptions& options);

}  // namespace brainshift::solve
