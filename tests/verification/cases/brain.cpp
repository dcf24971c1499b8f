// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wittek et al., figure 4: brain shift on the brain of the demo, MLS and MMLS on two kinds of cells, against finite
// elements on the same geometry, load and material.

#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/loaded_brain.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification::brain_cases {

Outcome brain(bool small) {
  const Reference reference = read_reference("brain", "");
  const std::size_t nodes = small ? 3000 : 19000;
  Outcome outcome;
  for (const auto& [cell_name, kind] :
       {std::pair{"hexahedra", CellKind::hexahedron}, std::pair{"tetrahedra", CellKind::tetrahedron}}) {
    solve::Model model = loaded_brain(nodes, kind);
    model.materials[1] = {3000, 0.49, 1000};
    for (const auto& [basis_name, basis, bounded] :
         {std::tuple{"MMLS", Basis::modified_quadratic, true}, {"MLS, linear basis", Basis::linear, false}}) {
      solve::SolveOptions options;
      options.shape.basis = basis;
      options.start = solve::Start::coarse;
      options.points_per_cell = kind == CellKind::hexahedron ? 8 : 4;
      const solve::SolveResult result = solved(model, options);
      const Differences d = differences(result.solution, reference.positions, reference.displacement);
      const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
      const std::string name = std::string("brain shift, ") + std::to_string(model.cloud.size()) + " nodes, " +
                               cell_name + ", " + basis_name + ": ";
      const double wider = small ? 3 : 1;
      const auto bound = [&](double most) { return bounded ? std::optional(wider * most) : std::nullopt; };
      outcome.figures.push_back(
          {name + "mean difference", "< 0.2 mm", d.mean, "mm", bound(0.05), {}, reference.error, seconds});
      outcome.figures.push_back({name + "95 %", "", d.percentile95, "mm", bound(0.15), {}, reference.error, seconds});
      const double estimate = result.measures.estimated_error_95.value_or(0) / d.percentile95;
      outcome.figures.push_back(
          {name + "estimated error / difference, 95 %", "", estimate, "", 5, 0.5, reference.error, seconds});
      outcome.figures.push_back({name + "largest", "", d.largest, "mm", bound(0.5), {}, reference.error, seconds});
    }
  }
  return outcome;
}

}  // namespace brainshift::verification::brain_cases
