// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/load_options.hpp"

namespace brainshift::solve {

const OptionTable<OpeningOptions>& opening_options() {
  using Options = OpeningOptions;
  static const OptionTable<Options> table = {
      number_option<Options>("margin", &Options::margin, any_number, "mm",
                             "how far past the outermost measured points the opening reaches; negative: half their "
                             "median distance to each other"),
      number_option<Options>("depth", &Options::depth, above_zero, "mm",
                             "a node this far above or below the measured surface is not under the opening"),
      number_option<Options>("farthest", &Options::farthest, above_zero, "mm",
                             "a measured point farther than this from any surface node is an error")};
  return table;
}

const OptionTable<SimulatedCraniotomy>& simulated_craniotomy_options() {
  using Options = SimulatedCraniotomy;
  static const OptionTable<Options> table = {
      required(vector_option<Options>("centre", &Options::centre, "mm, LPS",
                                      "near the middle of the opening; the nearest point of the surface is taken")),
      number_option<Options>("radius", &Options::radius, above_zero, "mm", "of the opening"),
      number_option<Options>("depth", &Options::depth, above_zero, "mm", "inward displacement at the centre")};
  return table;
}

}  // namespace brainshift::solve
