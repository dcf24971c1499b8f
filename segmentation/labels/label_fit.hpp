// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "segmentation/image/image.hpp"

namespace brainshift::segmentation {

/// How well a T1 fits a label map of the same grid: its mean change across the boundary of the brain's labels, over the
/// mean of that with the labels shifted by 4 mm along each axis, to and fro. Labels of another head find as many edges
/// beside them as at them: 1. Any contrast will do, as only the size of the change counts; the T1 is smoothed by 1 mm
/// against noise. Empty where the boundary is too short to tell, or the T1 has no contrast there.
std::optional<double> label_fit(const ScalarImage& t1, const LabelMap& labels, std::span<const std::uint16_t> brain);

}  // namespace brainshift::segmentation
