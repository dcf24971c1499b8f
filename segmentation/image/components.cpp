// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/itk_bridge.hpp"

#include <itkConnectedComponentImageFilter.h>

#include "segmentation/image/mask.hpp"

namespace brainshift {

Components components(const Mask& mask) {
  const auto seen = seen_by_itk(mask);
  auto filter = itk::ConnectedComponentImageFilter<ItkImage<std::uint8_t>, ItkImage<std::int32_t>>::New();
  filter->SetInput(seen);
  filter->SetFullyConnected(false);
  filter->Update();
  const auto* const numbers = filter->GetOutput()->GetBufferPointer();
  Components result{.number = {numbers, numbers + mask.voxels.size()},
                    .sizes = std::vector<std::size_t>(filter->GetObjectCount())};
  for (const std::int32_t number : result.number) {
    if (number != 0) {
      ++result.sizes[static_cast<std::size_t>(number - 1)];
    }
  }
  return result;
}

}  // namespace brainshift
