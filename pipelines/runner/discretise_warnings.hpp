// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/interface/options.hpp"
#include "pipelines/runner/warnings.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::pipelines {

/// Of a body that does not lie where its label map has brain, as where either is in another frame, and of finer nodes
/// at a tumour that the map does not have.
Warnings warnings_of(const Surface& brain, const LabelMap& labels, const discretise::DiscretiseOptions& options);

}  // namespace brainshift::pipelines
