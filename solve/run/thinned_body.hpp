// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "solve/interface/model.hpp"
#include "solve/interface/shape_options.hpp"
#include "solve/measured/response.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// A model on at most 500 of its nodes, linear: what measured points say of the deformation is asked of it.
struct ThinnedBody {
  std::vector<std::int32_t> node;  ///< of the model's cloud
  StiffBody stiff;

  /// Its shape functions; linear, as it has few nodes.
  ShapeFunctions shape() const { return {stiff.cloud.positions, stiff.cloud.spacing, {.basis = Basis::linear}}; }
};

/// Loaded nodes stay rather than others. Throws as solve() does.
ThinnedBody thinned_body(const Model& model, const ShapeOptions& options);

}  // namespace brainshift::solve
