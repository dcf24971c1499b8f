// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/read_mask.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "segmentation/files/refuse.hpp"
#include "segmentation/geometry/quantile.hpp"
#include "segmentation/image/mask.hpp"

namespace brainshift {
namespace {

/// Numbers from 0 to 1 of which most are near the one or the other, but not all are, are probabilities or a mask that
/// was resampled. Those of a stripped image that was scaled to 1 lie between.
bool are_probabilities(const std::vector<float>& voxels) {
  constexpr float near = 0.05F;
  std::size_t at_ends = 0, between = 0, whole = 0;
  for (const float value : voxels) {
    if (value < 0 || value > 1) {
      return false;
    }
    whole += value == 1 ? 1 : 0;
    (value < near || value > 1 - near ? at_ends : between) += value != 0 ? 1 : 0;
  }
  return at_ends > between && whole < at_ends + between;
}

/// Whole numbers that most voxels share with the next one, as those of an atlas do and intensities do not.
bool are_labels(const std::vector<float>& voxels) {
  std::size_t pairs = 0, same = 0;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (voxels[i] < 0 || voxels[i] != std::floor(voxels[i])) {
      return false;
    }
    const bool pair = i > 0 && voxels[i] != 0 && voxels[i - 1] != 0;
    pairs += pair ? 1 : 0;
    same += pair && voxels[i] == voxels[i - 1] ? 1 : 0;
  }
  return 2 * same >= pairs;
}

/// Of the sizes of what is not 0; there is some.
float high_value(const std::vector<float>& voxels) {
  std::vector<float> sizes;
  for (const float value : voxels) {
    if (value != 0) {
      sizes.push_back(std::abs(value));
    }
  }
  return quantile(std::move(sizes), 0.99);
}

/// Whether 0 lies among the tissues, as where intensities were divided by their deviation from the mean.
bool are_about_zero(const std::vector<float>& voxels, float high) {
  constexpr float clearly = 0.1F;
  std::size_t large = 0, negative = 0;
  for (const float value : voxels) {
    large += std::abs(value) > clearly * high ? 1 : 0;
    negative += value < -clearly * high ? 1 : 0;
  }
  return 10 * negative > large;
}

Mask above(const ScalarImage& image, float threshold) {
  Mask mask{image.geometry, std::vector<std::uint8_t>(image.voxels.size())};
  std::transform(image.voxels.begin(), image.voxels.end(), mask.voxels.begin(),
                 [&](float value) { return static_cast<std::uint8_t>(value > threshold ? 1 : 0); });
  return mask;
}

std::string doubtful_sentence(const std::filesystem::path& file, double volume, double share) {
  std::ostringstream text;
  text << "warning: " << file.string() << ": " << std::lround(volume / 1000) << " ml of its voxels that are not 0 ("
       << std::lround(100 * share)
       << " %) are nearly 0 or negative, as around an image that was resampled by splines; they count as outside but "
          "where the others enclose them. Give a mask of 0 and 1, resampled to the nearest voxel";
  return text.str();
}

/// Of an image that a spline resampled, which rings about 0 outside the brain: what is brighter than the rings, and
/// what lies dark in it. Heads as they were stripped have up to 1.3 % of voxels below 2 % of a high value, resampled
/// ones 2.2 % and more.
void take_off_rings(const std::filesystem::path& file, const ScalarImage& image, Mask& mask, std::string& warning) {
  constexpr float doubtful = 0.02F;
  constexpr double much = 0.02, gap = 2;  // mm, half of what is sealed between dark fluid inside and outside
  const std::size_t all = count(mask);
  if (all == 0 || are_labels(image.voxels)) {
    return;
  }
  const float high = high_value(image.voxels);
  const Mask bright = above(image, doubtful * high);
  const double share = 1 - static_cast<double>(count(bright)) / static_cast<double>(all);
  if (share <= much || are_about_zero(image.voxels, high)) {
    return;
  }
  warning = doubtful_sentence(file, share * volume(mask), share);
  const Mask inside = holes_filled(closed(largest_component(bright), gap));
  for (std::size_t i = 0; i < mask.voxels.size(); ++i) {
    mask.voxels[i] = bright.voxels[i] != 0 || (mask.voxels[i] != 0 && inside.voxels[i] != 0) ? 1 : 0;
  }
}

}  // namespace

ReadMask read_mask_and_warning(const std::filesystem::path& file) {
  const ScalarImage image = read_image(file);
  if (are_probabilities(image.voxels)) {
    refuse(file,
           "holds numbers between 0 and 1, as probabilities or a mask that was resampled do; give a mask with 1 "
           "where they are above a half, else 0");
  }
  Mask mask{image.geometry, std::vector<std::uint8_t>(image.voxels.size())};
  std::transform(image.voxels.begin(), image.voxels.end(), mask.voxels.begin(),
                 [](float value) { return static_cast<std::uint8_t>(value != 0 ? 1 : 0); });
  ReadMask read;
  take_off_rings(file, image, mask, read.warning);
  read.map = {image.geometry, {mask.voxels.begin(), mask.voxels.end()}};
  return read;
}

LabelMap read_mask(const std::filesystem::path& file) {
  return read_mask_and_warning(file).map;
}

}  // namespace brainshift
