// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "register/field/brain_zones.hpp"
#include "register/field/forward_field.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::registration {

/// The forward field of one body again and again: what does not depend on its displacement is made once and kept.
class RepeatedField {
 public:
  /// Throws as brain_zones() and forward_field().
  RepeatedField(const Solution& solution, const Surface& brain, const ImageGeometry& grid, double fade);

  /// parameters: the nodes' û, (n × 3) mm. What forward_field() gives, to rounding.
  VectorImage forward(const Points& parameters);

 private:
  ImageGeometry grid_;
  double fade_, spacing_;
  BrainZones zones_;
  std::vector<solve::ShapeRows> rows_;  ///< part by part as forward_field() asks
  FieldPlan plan_;
};

/// A grid of voxels of one size that covers an image.
ImageGeometry covering_grid(const ImageGeometry& image, double spacing);

}  // namespace brainshift::registration
