// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "pipelines/runner/warnings.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::pipelines {

/// Of labels that lie where a T1 of the same grid is black, or whose boundary is none in it: it is of another head or
/// frame. brain: the labels of the brain.
Warnings warnings_of(const ScalarImage& t1, const LabelMap& labels, std::span<const std::uint16_t> brain);

}  // namespace brainshift::pipelines
