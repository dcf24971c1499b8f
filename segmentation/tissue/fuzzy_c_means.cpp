// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/tissue/fuzzy_c_means.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace brainshift::segmentation {
namespace {

constexpr std::size_t bins = 1024;

struct Histogram {
  double lowest = 0;
  double width = 0;  // of a bin
  std::vector<double> counts = std::vector<double>(bins);

  double centre(std::size_t bin) const { return lowest + (static_cast<double>(bin) + 0.5) * width; }
};

Histogram histogram_of(std::span<const float> values) {
  std::vector<float> sorted(values.begin(), values.end());
  const std::size_t ignored = sorted.size() / 1000;
  const auto low = sorted.begin() + static_cast<std::ptrdiff_t>(ignored);
  const auto high = sorted.end() - 1 - static_cast<std::ptrdiff_t>(ignored);
  std::nth_element(sorted.begin(), low, sorted.end());
  const double lowest = *low;
  std::nth_element(sorted.begin(), high, sorted.end());
  const double highest = *high;
  Histogram histogram;
  histogram.lowest = lowest;
  histogram.width = (highest - lowest) / static_cast<double>(bins);
  if (!(histogram.width > 0)) {
    return histogram;
  }
  for (const float value : values) {
    const double place = (static_cast<double>(value) - lowest) / histogram.width;
    ++histogram.counts[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(bins - 1)))];
  }
  return histogram;
}

// Evenly over the range, so that no two start together.
std::vector<double> starting_centres(const Histogram& histogram, int classes) {
  std::vector<double> centres;
  const double range = histogram.width * static_cast<double>(bins);
  for (int c = 0; c < classes; ++c) {
    centres.push_back(histogram.lowest + range * (c + 0.5) / classes);
  }
  return centres;
}

std::vector<double> moved_centres(const Histogram& histogram, const std::vector<double>& centres) {
  std::vector<double> memberships(centres.size());
  std::vector<double> weights(centres.size());
  std::vector<double> sums(centres.size());
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const double value = histogram.centre(bin);
    fuzzy_memberships(centres, value, memberships);
    for (std::size_t c = 0; c < centres.size(); ++c) {
      const double weight = histogram.counts[bin] * memberships[c] * memberships[c];
      weights[c] += weight;
      sums[c] += weight * value;
    }
  }
  for (std::size_t c = 0; c < centres.size(); ++c) {
    sums[c] /= weights[c];
  }
  return sums;
}

}  // namespace

void fuzzy_memberships(std::span<const double> centres, double value, std::span<double> memberships) {
  constexpr double smallest = 1e-290;  // on a centre, the membership in its class is 1
  double total = 0;
  for (std::size_t c = 0; c < centres.size(); ++c) {
    const double distance = value - centres[c];
    memberships[c] = 1.0 / std::max(distance * distance, smallest);
    total += memberships[c];
  }
  for (double& membership : memberships) {
    membership /= total;
  }
}

std::vector<double> fuzzy_c_means(std::span<const float> values, int classes) {
  if (classes < 2) {
    throw std::invalid_argument("fuzzy c-means needs at least 2 classes, " + std::to_string(classes) +
                                " were asked for");
  }
  const bool finite = std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
  if (values.empty() || !finite) {
    throw std::invalid_argument("the image's values inside the brain mask must be finite numbers; replace the others");
  }
  const Histogram histogram = histogram_of(values);
  const auto filled = std::count_if(histogram.counts.begin(), histogram.counts.end(), [](double n) { return n > 0; });
  if (filled < classes) {
    throw std::invalid_argument("the image's values inside the brain mask are too alike for " +
                                std::to_string(classes) + " classes; is it the right image?");
  }
  std::vector<double> centres = starting_centres(histogram, classes);
  constexpr int most_iterations = 1000;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const std::vector<double> moved = moved_centres(histogram, centres);
    double largest = 0;
    for (std::size_t c = 0; c < centres.size(); ++c) {
      largest = std::max(largest, std::abs(moved[c] - centres[c]));
    }
    centres = moved;
    if (largest < 1e-3 * histogram.width) {
      break;
    }
  }
  std::sort(centres.begin(), centres.end());
  return centres;
}

}  // namespace brainshift::segmentation
