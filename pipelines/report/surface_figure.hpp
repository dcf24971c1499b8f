// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/report/slice_figures.hpp"

namespace brainshift::pipelines {

/// The brain's surface as it lies during the operation, coloured by displacement: seen through the opening, and from
/// the side. The opening's rim is drawn on it.
Figure surface_figure(const RunData& run, const View& view);

}  // namespace brainshift::pipelines
