// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/image_warnings.hpp"

#include <algorithm>

#include "segmentation/labels/label_fit.hpp"

namespace brainshift::pipelines {

Warnings warnings_of(const ScalarImage& t1, const LabelMap& labels, std::span<const std::uint16_t> brain) {
  std::size_t all = 0, black = 0;
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    if (std::ranges::find(brain, labels.voxels[i]) != brain.end()) {
      ++all;
      black += t1.voxels[i] == 0 ? 1 : 0;
    }
  }
  const double share = all == 0 ? 0 : static_cast<double>(black) / static_cast<double>(all);
  constexpr double usual = 0.1;  // masks differ by a rim
  if (share >= usual) {
    return {with_digits(100 * share) +
            " % of the labelled brain lie where the T1 is 0; are labels and T1 of one patient and one frame?"};
  }
  // Of heads with their own T1, with noise or 2 mm off, 1.18 and more; of other persons', moved to the same place and
  // size, 1.07 and less.
  constexpr double least_fit = 1.1;
  const auto fit = segmentation::label_fit(t1, labels, brain);
  if (fit && *fit < least_fit) {
    return {
        "at the boundary of the labelled brain the T1 changes " + with_digits(*fit) +
        " times as much as 4 mm beside it, where a T1 that belongs to the labels changes 1.2 times as much or more; "
        "are labels and T1 of one patient and one frame?"};
  }
  return {};
}

}  // namespace brainshift::pipelines
