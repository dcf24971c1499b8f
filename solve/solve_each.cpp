// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve_each.hpp"

#include <stdexcept>
#include <string>

#include "solve/interface/option_table.hpp"
#include "solve/interface/unfit_parts.hpp"
#include "solve/material/check_material.hpp"
#include "solve/run/together.hpp"

namespace brainshift::solve {

namespace {

void check_each(const Model& model, const SolveOptions& options, std::span<const Constants> constants) {
  check_options(options);
  refuse_unfit("many constants at once do not go",
               {
                   {model.conditions.measured.has_value(), "a load with noise"},
                   {options.dynamics == Dynamics::transient, "motion in time"},
                   {options.region > 0, "a region"},
                   {model.resection.has_value(), "a resection"},
               },
               "solve them one by one");
  for (std::size_t m = 0; m < constants.size(); ++m) {
    for (const auto& [label, material] : model.materials) {
      if (!constants[m].materials.contains(label)) {
        throw std::invalid_argument("constants " + std::to_string(m) + " have no material for label " +
                                    std::to_string(label) + ", as the model has; give each the same labels");
      }
    }
    for (const auto& [label, material] : constants[m].materials) {
      check_material("the material of label " + std::to_string(label) + " in constants " + std::to_string(m), material);
    }
  }
}

}  // namespace

std::vector<std::optional<Points>> solve_each(const Model& model, const SolveOptions& options,
                                              std::span<const Constants> constants, const Progress& progress) {
  check_each(model, options, constants);
  return whole_displacements(model, options, constants, progress);
}

}  // namespace brainshift::solve
