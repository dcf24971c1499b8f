// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "solve/body/body.hpp"
#include "solve/body/body_parts.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// What of a body is not in its parts.
struct LayOutExtras {
  CutFacets cut = {};                       ///< that parts it, the septum too
  std::span<const FacePair> faces = {};     ///< nodes of the cuts' faces, by the cloud's own numbers
  std::span<const std::int32_t> held = {};  ///< ordered nodes whose prescribed displacement is held, not loaded
  std::shared_ptr<const SignedDistance> skull = {};  ///< of the model, where its distances are known already
};

/// Lays parts out for stepping. Throws TooFewNodes where a node lies in no support, or the prescribed displacements
/// contradict each other; std::invalid_argument on a skull that is no closed surface.
Body lay_out(const Model& model, const SolveOptions& options, const BodyParts& parts, LayOutExtras extras);

/// The laws of a body that comes to rest in space, were its tissues of these materials, by label.
PointLaws laws_with(const Body& body, const std::map<std::int32_t, Material>& materials);

}  // namespace brainshift::solve
