// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::segmentation {

/// What goes in: labels, or a T1 with a brain mask, or a brain surface (possibly broken). Exactly one of them; a T1 may
/// come with labels (only its geometry is compared) and a tumour mask with labels or mask (it becomes label 3).
struct SegmentInput {
  std::optional<ScalarImage> t1;
  std::optional<LabelMap> labels;
  std::optional<LabelMap> brain_mask;   ///< non-zero is brain
  std::optional<LabelMap> tumour_mask;  ///< non-zero is tumour
  std::optional<Surface> surface;
};

}  // namespace brainshift::segmentation
