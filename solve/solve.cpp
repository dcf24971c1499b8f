// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve.hpp"

#include "solve/body/check_model.hpp"
#include "solve/interface/option_table.hpp"
#include "solve/region/region.hpp"
#include "solve/run/measured.hpp"
#include "solve/run/whole_body.hpp"

namespace brainshift::solve {

SolveResult solve(const Model& model, const SolveOptions& options, const Progress& progress) {
  check_options(options);
  check_input(model);
  if (model.conditions.measured) {
    return solve_measured(model, options, progress);
  }
  return options.region > 0 ? solve_region(model, options, progress) : solve_whole_body(model, options, progress);
}

}  // namespace brainshift::solve
