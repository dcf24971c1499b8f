// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/classify.hpp"

#include <algorithm>

#include "segmentation/tissue/fuzzy_c_means.hpp"
#include "segmentation/tissue/ventricles.hpp"

namespace brainshift::segmentation {
namespace {

std::vector<float> values_inside(const ScalarImage& image, const Mask& mask) {
  std::vector<float> values;
  for (std::size_t i = 0; i < mask.voxels.size(); ++i) {
    if (mask.voxels[i] != 0) {
      values.push_back(image.voxels[i]);
    }
  }
  return values;
}

std::vector<ScalarImage> membership_images(const ScalarImage& t1, const Mask& brain,
                                           const std::vector<double>& centres) {
  const ScalarImage empty{t1.geometry, std::vector<float>(t1.voxels.size())};
  std::vector<ScalarImage> images(centres.size(), empty);
#pragma omp parallel
  {
    std::vector<double> memberships(centres.size());
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < t1.voxels.size(); ++i) {
      if (brain.voxels[i] != 0) {
        fuzzy_memberships(centres, t1.voxels[i], memberships);
        for (std::size_t c = 0; c < centres.size(); ++c) {
          images[c].voxels[i] = static_cast<float>(memberships[c]);
        }
      }
    }
  }
  return images;
}

Mask darkest_class(const std::vector<ScalarImage>& memberships, const Mask& brain) {
  Mask csf{brain.geometry, std::vector<std::uint8_t>(brain.voxels.size())};
  for (std::size_t i = 0; i < csf.voxels.size(); ++i) {
    const float darkest = memberships.front().voxels[i];
    const bool wins = std::all_of(memberships.begin() + 1, memberships.end(),
                                  [&](const ScalarImage& other) { return other.voxels[i] < darkest; });
    csf.voxels[i] = brain.voxels[i] != 0 && wins ? 1 : 0;
  }
  return csf;
}

}  // namespace

Classification classify(const ScalarImage& t1, const Mask& brain, const SegmentOptions& options) {
  const auto centres = fuzzy_c_means(values_inside(t1, brain), options.classes);
  Classification result;
  result.memberships = membership_images(t1, brain, centres);
  const Mask ventricles = find_ventricles(darkest_class(result.memberships, brain), brain, options.ventricle_depth);
  result.labels = LabelMap{t1.geometry, std::vector<std::uint16_t>(t1.voxels.size())};
  for (std::size_t i = 0; i < brain.voxels.size(); ++i) {
    if (brain.voxels[i] != 0) {
      result.labels.voxels[i] = ventricles.voxels[i] != 0 ? default_label::ventricles : default_label::parenchyma;
    }
  }
  return result;
}

}  // namespace brainshift::segmentation
