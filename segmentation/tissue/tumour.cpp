// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/tumour.hpp"

#include "segmentation/interface/options.hpp"
#include "segmentation/labels/label_table.hpp"

namespace brainshift::segmentation {

Mask in_body(const LabelMap& tumour_mask, const Mask& body) {
  Mask inside = mask_of(tumour_mask);
  for (std::size_t i = 0; i < inside.voxels.size(); ++i) {
    inside.voxels[i] = inside.voxels[i] != 0 && body.voxels[i] != 0 ? 1 : 0;
  }
  return inside;
}

void add_tumour(LabelMap& labels, const Mask& tumour) {
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    if (tumour.voxels[i] != 0) {
      labels.voxels[i] = default_label::tumour;
    }
  }
}

std::string outside_body(const LabelMap& tumour_mask, const Mask& body) {
  constexpr double much = 0.1;  // of the mask
  const double all = volume(mask_of(tumour_mask)), lost = all - volume(in_body(tumour_mask, body));
  if (!(lost > much * all)) {
    return {};
  }
  return "warning: " + in_millilitres(lost) + " of the tumour mask's " + in_millilitres(all) +
         " hang together with no part of the brain and are left out; is it the mask of this image, in its frame? If "
         "so, "
         "join it to the brain's labels or mask";
}

}  // namespace brainshift::segmentation
