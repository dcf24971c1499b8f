// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "segmentation/progress/progress.hpp"
#include "solve/body/body.hpp"
#include "solve/body/body_parts.hpp"
#include "solve/cut/cut_body.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

/// A model as stepping needs it; what was only needed to make it is gone.
struct Prepared {
  Body body;
  std::optional<CutBody> cut;      ///< absent: a scene without one
  std::optional<BodyParts> parts;  ///< where cuts go on or they are asked for; else they are gone
};

/// pinned: one a node of the cloud, not 0 where the prescribed displacement is that of the node's parameter û (and the
/// node's row of shape functions 1 at itself); empty: none. Such a node is held, not loaded. Sets the sizes among the
/// measures. Of a model with a resection this is what it leaves, resect(). keep_parts: see Prepared. Throws as solve()
/// does.
Prepared prepare(const Model& model, const SolveOptions& options, std::span<const std::uint8_t> pinned,
                 SolveMeasures& measures, const Progress& progress, bool keep_parts = false);

}  // namespace brainshift::solve
