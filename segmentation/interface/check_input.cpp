// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/interface/check_input.hpp"

#include <algorithm>
#include <stdexcept>

#include "segmentation/interface/option_table.hpp"

namespace brainshift::segmentation {
namespace {

template <class A, class B>
void check_same_geometry(const Image<A>& a, const char* name_a, const std::optional<Image<B>>& b, const char* name_b) {
  if (b && !same_geometry(a.geometry, b->geometry)) {
    throw std::invalid_argument(std::string(name_a) + " and " + name_b + " lie on different grids (" +
                                described(a.geometry) + " against " + described(b->geometry) +
                                ", or another direction); resample one onto the other's grid");
  }
}

void check_labels(const SegmentInput& input, const SegmentOptions& options) {
  check_same_geometry(*input.labels, "the labels", input.t1, "the T1");
  check_same_geometry(*input.labels, "the labels", input.tumour_mask, "the tumour mask");
  if (options.brain_labels.empty()) {
    throw std::invalid_argument("no label is said to be brain; name at least one");
  }
  const auto& brain = options.brain_labels;
  if (input.tumour_mask && std::find(brain.begin(), brain.end(), default_label::tumour) == brain.end()) {
    const std::string number = std::to_string(default_label::tumour);
    throw std::invalid_argument(
        "the tumour mask's label, " + number +
        ", is not among those that are brain, so that the tumour would be cut out of it; name " + number + ", too");
  }
}

void check_masked_t1(const SegmentInput& input) {
  if (!input.t1 || !input.brain_mask) {
    throw std::invalid_argument("give labels, or a T1 with a brain mask, or a brain surface");
  }
  check_same_geometry(*input.t1, "the T1", input.brain_mask, "the brain mask");
  check_same_geometry(*input.t1, "the T1", input.tumour_mask, "the tumour mask");
}

}  // namespace

void check_input(const SegmentInput& input, const SegmentOptions& options) {
  check_options(options);
  if (input.labels.has_value() + input.brain_mask.has_value() + input.surface.has_value() > 1) {
    throw std::invalid_argument("give only one of labels, brain mask and brain surface");
  }
  if (input.labels) {
    check_labels(input, options);
  } else if (!input.surface) {
    check_masked_t1(input);
  }
}

}  // namespace brainshift::segmentation
