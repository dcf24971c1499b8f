// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// The options with what the model says of them: the shape functions of a plane, and double precision where single does
/// not serve.
SolveOptions completed(SolveOptions options, const Model& model);

}  // namespace brainshift::solve
