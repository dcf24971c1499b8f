// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Throws solve::device::NotOnDevice where a stage of ours from `from` to `until` is to be done on a GPU alone, and
/// there is none: said before anything is computed.
void require_gpu(const Scene& scene, StageId from, StageId until);

}  // namespace brainshift::pipelines
