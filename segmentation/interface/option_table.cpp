// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/interface/option_table.hpp"

namespace brainshift::segmentation {

const OptionTable<SegmentOptions>& segment_options() {
  using Options = SegmentOptions;
  static const OptionTable<Options> table = {
      number_option<Options>("edge_length", &Options::edge_length, {.low = 0.5}, "mm",
                             "target edge of the remeshed surfaces; at most a sixth of the brain's extent, or 5"),
      number_option<Options>(
          "closing", &Options::closing, {.low = 0, .high = 20}, "mm",
          "gaps of the brain narrower than twice this are closed, so that sulci are not folds of its "
          "surface; 0: none; absent: 4 where a table tells the labels, else none"),
      choice_option<Options>("tissue_surfaces", &Options::tissue_surfaces, {{"no", false}, {"yes", true}},
                             "whether each tissue gets a surface, which no later stage needs"),
      number_option<Options>("classes", &Options::classes, {.low = 2, .high = 10}, "",
                             "fuzzy c-means classes (CSF, grey, white) when there are no labels"),
      number_option<Options>("ventricle_depth", &Options::ventricle_depth, not_negative, "mm",
                             "CSF is ventricle where most of its body lies this deep in the brain")};
  return table;
}

void check_options(const SegmentOptions& options) {
  check_table(segment_options(), options);
}

}  // namespace brainshift::segmentation
