// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "pipelines/runner/warnings.hpp"
#include "solve/interface/model.hpp"

namespace brainshift::pipelines {

/// Of a body that nothing but its measured load, on less than half of its surface, holds. displacement: what came out,
/// (n × 3) mm.
Warnings warnings_of(const solve::Model& model, const Points& displacement);

/// Of a brain that has turned in its skull, where it slides without friction, of an answer that is hardly larger
/// than its estimated error, and of nodes beside a septum that move farther than all that is loaded. Without a measured
/// load a turn that is no small one is no answer: turn_fault().
Warnings warnings_of(const solve::Model& model, const Solution& solution);

/// Empty, or why a body that nothing but contact holds has no answer: fluid that drains or tissue that swells as the
/// image has it goes along with a brain that turns, and turns it on.
std::string turn_fault(const solve::Model& model, const Solution& solution);

/// Of soft tissue, as fluid is modelled, that a drained level leaves with its whole weight.
Warnings warnings_of_rooms(const solve::Model& model);

/// Of levels of the fluid above or below the whole brain, and of tissues that float in it where gravity has turned.
Warnings warnings_of_levels(const solve::Model& model);

/// Of a head that is weighed as if it did not float.
Warnings warnings_of_gravity(const solve::Model& model);

}  // namespace brainshift::pipelines
