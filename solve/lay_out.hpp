// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "solve/pieces.hpp"
#include "solve/prepare.hpp"

namespace brainshift::solve {

/// Lays pieces out for stepping. faces: the nodes of cuts' faces. held: nodes whose prescribed displacement counts as
/// held, not as loaded. skull: of the model, where its distances are known already. Throws std::invalid_argument where
/// a node lies in no support, or the prescribed displacements contradict each other.
Prepared lay_out(const Model& model, const SolveOptions& options, const Pieces& pieces, std::span<const FacePair> faces,
                 std::span<const std::int32_t> held, std::optional<SignedDistance> skull = {});

}  // namespace brainshift::solve
