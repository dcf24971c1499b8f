// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/tumour.hpp"

#include <iomanip>
#include <sstream>

#include "segmentation/interface/options.hpp"

namespace brainshift::segmentation {

void add_tumour(LabelMap& labels, const LabelMap& tumour_mask) {
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    if (tumour_mask.voxels[i] != 0) {
      labels.voxels[i] = default_label::tumour;
    }
  }
}

void add_tumour(LabelMap& labels, const LabelMap& tumour_mask, const Mask& body) {
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    if (tumour_mask.voxels[i] != 0 && body.voxels[i] != 0) {
      labels.voxels[i] = default_label::tumour;
    }
  }
}

std::string outside_body(const LabelMap& tumour_mask, const Mask& body) {
  constexpr double much = 0.1;  // of the mask
  Mask outside = mask_of(tumour_mask);
  const double all = volume(outside);
  for (std::size_t i = 0; i < outside.voxels.size(); ++i) {
    outside.voxels[i] = outside.voxels[i] != 0 && body.voxels[i] == 0 ? 1 : 0;
  }
  const double lost = volume(outside);
  if (!(lost > much * all)) {
    return {};
  }
  std::ostringstream text;
  text << "warning: " << std::fixed << std::setprecision(1) << lost / 1000 << " of the tumour mask's " << all / 1000
       << " ml hang together with no part of the brain and are left out; is it the mask of this image, in its frame? "
          "If so, join it to the brain's labels or mask";
  return text.str();
}

}  // namespace brainshift::segmentation
