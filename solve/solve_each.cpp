// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solve_each.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "solve/body/check_model.hpp"
#include "solve/body/stiff_parts.hpp"
#include "solve/interface/option_table.hpp"
#include "solve/interface/unfit_parts.hpp"
#include "solve/material/check_material.hpp"
#include "solve/run/together.hpp"

namespace brainshift::solve {

namespace {

void check_each(const Model& model, const SolveOptions& options, std::span<const Constants> constants) {
  check_options(options);
  check_input(model);
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

/// What a body goes by in the stiffness of its tissues, hide_soft_nodes() and stiff_parts(): how that of each stands to
/// that of each other. Constants of one order make the same body.
std::vector<int> stiffness_order(const std::map<std::int32_t, Material>& materials) {
  std::vector<int> order;
  for (const auto& [label, material] : materials) {
    for (const auto& [other_label, other] : materials) {
      const double modulus = shear_modulus(material), of_other = shear_modulus(other);
      order.push_back((modulus > of_other ? 1 : 0) + (much_stiffer(modulus, of_other) ? 1 : 0) +
                      (modulus >= nearly_rigid * of_other ? 1 : 0));
    }
  }
  return order;
}

}  // namespace

std::vector<std::optional<Points>> solve_each(const Model& model, const SolveOptions& options,
                                              std::span<const Constants> constants, const Progress& progress) {
  check_each(model, options, constants);
  std::map<std::vector<int>, std::vector<std::size_t>> of_order;
  for (std::size_t m = 0; m < constants.size(); ++m) {
    of_order[stiffness_order(constants[m].materials)].push_back(m);
  }
  std::vector<std::optional<Points>> displacements(constants.size());
  for (const auto& [order, which] : of_order) {
    Model with = model;
    with.materials = constants[which.front()].materials;
    std::vector<Constants> some;
    for (const std::size_t m : which) {
      some.push_back(constants[m]);
    }
    std::vector<std::optional<Points>> found = whole_displacements(with, options, some, progress);
    for (std::size_t i = 0; i < which.size(); ++i) {
      displacements[which[i]] = std::move(found[i]);
    }
  }
  return displacements;
}

}  // namespace brainshift::solve
