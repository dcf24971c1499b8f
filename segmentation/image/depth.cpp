// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/itk_bridge.hpp"

#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>

#include "segmentation/image/mask.hpp"

namespace brainshift {

ScalarImage depth(const Mask& mask) {
  const Mask outside = complement(mask);
  const auto seen = seen_by_itk(outside);
  auto filter = itk::SignedMaurerDistanceMapImageFilter<ItkImage<std::uint8_t>, ItkImage<float>>::New();
  filter->SetInput(seen);
  filter->SetSquaredDistance(false);
  filter->SetUseImageSpacing(true);
  filter->Update();
  ScalarImage result = from_itk<float>(*filter->GetOutput());
  for (float& value : result.voxels) {
    value = std::max(value, 0.0F);
  }
  return result;
}

}  // namespace brainshift
