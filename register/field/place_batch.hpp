// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace brainshift::registration {

constexpr int batch_size = 4;

/// One number for each place of a batch.
using Lanes = double __attribute__((vector_size(batch_size * sizeof(double))));

struct BatchNode {
  double position[3];   ///< mm
  double radius;        ///< of its support, mm; grown where supports are
  double parameter[3];  ///< û, mm
};

/// Places that are interpolated at together, and all nodes that any of them sees.
struct PlaceBatch {
  std::span<const BatchNode> nodes;
  double length;   ///< that scales the coordinates, mm: about the largest radius
  double penalty;  ///< µ of MMLS
  Lanes place[3];
  Lanes displacement[3];  ///< Σφû, the result
  Lanes verdict;          ///< on the support: 1 admissible, -1 not, 0 too near to the limit to tell
};

/// Moving least squares as in solve/shape, of the linear and of the (modified) quadratic basis.
void interpolate_linear(PlaceBatch& batch);
void interpolate_quadratic(PlaceBatch& batch);

}  // namespace brainshift::registration
