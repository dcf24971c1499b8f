// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/interface/node_cloud.hpp"
#include "pipelines/scene/scene.hpp"
#include "solve/interface/conditions.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::pipelines {

/// Standard deviations of measured points where their file says none, and the scene does.
void add_noise(const Load& how, solve::CraniotomyLoad& load);

/// A load at the nodes of a cloud, as measured where standard deviations are known, else exactly; without forces.
/// Throws std::invalid_argument as prescribed_on_surface_nodes() and noisy_conditions() do.
solve::Conditions imposed(const solve::CraniotomyLoad& load, const Load& how, const NodeCloud& cloud);

}  // namespace brainshift::pipelines
