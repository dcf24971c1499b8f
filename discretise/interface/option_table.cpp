// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/interface/option_table.hpp"

namespace brainshift::discretise {
namespace {

/// Of spacing / uniform spacing. Below a tenth, cells that are split three times do not grade well.
constexpr Range finer{.low = 0.1, .high = 1};

}  // namespace

const OptionTable<DiscretiseOptions>& discretise_options() {
  using Options = DiscretiseOptions;
  static const OptionTable<Options> table = {
      number_option<Options>("nodes", &Options::nodes, {.low = 30, .high = 2e7}, "",
                             "wanted number of nodes, or spacing; 12000 when neither is given"),
      number_option<Options>("spacing", &Options::spacing, {.low = 1e-6, .high = 1e6}, "mm",
                             "distance between nodes, or nodes"),
      number_option<Options>("minimum_distance", &Options::minimum_distance, {.low = 0, .high = 0.7}, "",
                             "no two nodes nearer than this fraction of the local spacing"),
      number_option<Options>("tumour_factor", &Options::tumour_factor, finer, "",
                             "spacing in and at the tumour / uniform spacing"),
      number_option<Options>("tumour_label", &Options::tumour_label, label_numbers, "", "label of the tumour"),
      number_option<Options>(
          "tissue_boundary_factor", &Options::tissue_boundary_factor, finer, "",
          "spacing at boundaries between tissues / uniform spacing; of a scene's those where stiffness changes "
          "threefold"),
      choice_option<Options>("cells", &Options::cells,
                             {{"hexahedra", CellKind::hexahedron}, {"tetrahedra", CellKind::tetrahedron}},
                             "background cells for integration"),
      number_option<Options>("cells_per_node", &Options::cells_per_node, {.low = 0.05, .high = 100}, "",
                             "hexahedra: cells a node"),
      number_option<Options>("seed", &Options::seed, not_negative, "",
                             "of the randomness; the same seed gives the same files")};
  return table;
}

const OptionTable<Refinement>& refinement_options() {
  static const OptionTable<Refinement> table = {
      number_option<Refinement>(
          "craniotomy_factor", &Refinement::factor, finer, "",
          "spacing near the load, if there is one / uniform spacing; at 1 nodes know nothing of the load"),
      number_option<Refinement>("craniotomy_radius", &Refinement::radius, {.low = 1e-3, .high = 1e6}, "mm",
                                "how far near the load is; beyond it the spacing grows by a quarter of the distance")};
  return table;
}

void check_options(const DiscretiseOptions& options) {
  if (options.spacing && options.nodes) {
    throw std::invalid_argument("both spacing and nodes are given; give one of them");
  }
  check_table(discretise_options(), options);
  if (options.craniotomy) {
    check_table(refinement_options(), *options.craniotomy);
    if (!options.craniotomy->centres.allFinite()) {
      throw std::invalid_argument("a centre of the craniotomy's refinement is not finite");
    }
  }
}

}  // namespace brainshift::discretise
