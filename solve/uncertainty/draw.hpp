// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/interface/constants.hpp"
#include "solve/uncertainty/uncertainty_options.hpp"

namespace brainshift::solve {

/// Sample `sample` >= 1 of the constants of a model; the same for the same seed and sample, whatever was drawn before:
/// a longer series begins as a shorter one. Each tissue's moduli are multiplied by exp(stiffness · ε), its Poisson's
/// ratio is uniform (of a law of one's own that alone is drawn); gravity is turned about the two axes across it, now
/// and of the image by the same turn; the fluid's surface is turned with it about the middle of the nodes and moved.
Constants drawn_constants(const Model& model, const UncertaintyOptions& options, int sample);

/// Whether anything can come out of a draw but what the model says.
bool varies(const Model& model, const UncertaintyOptions& options);

}  // namespace brainshift::solve
