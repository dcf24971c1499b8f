// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/answer_warnings.hpp"

#include <algorithm>
#include <iterator>

#include "segmentation/geometry/quantile.hpp"
#include "solve/body/check_model.hpp"
#include "solve/body/ordered_cloud.hpp"
#include "solve/load/rigid_fit.hpp"
#include "solve/material/material.hpp"
#include "solve/run/error_estimate.hpp"

namespace brainshift::pipelines {

namespace {

std::vector<double> lengths_of(const Points& displacement) {
  const Eigen::VectorXd lengths = displacement.rowwise().norm();
  return {lengths.begin(), lengths.end()};
}

double turn_of(const Solution& solution) {
  return solve::fit_rigid(solution.positions, solution.positions + solution.displacement, Points(0, 3)).angle();
}

/// Nothing but the load moves such a brain, and nothing in it farther than the load, or hardly.
Warnings warnings_beside_septum(const solve::Model& model, const Points& displacement) {
  constexpr double much_farther = 1.2;
  const Points& prescribed = model.conditions.displacement;
  if (!model.septum || solve::is_pushed(model)) {
    return {};
  }
  double loaded = 0;
  for (const auto& u : prescribed.rowwise()) {
    loaded = std::max(loaded, u.allFinite() ? u.norm() : 0);
  }
  const double moved = displacement.rowwise().norm().maxCoeff();
  if (loaded == 0 || moved <= much_farther * loaded) {
    return {};
  }
  return {"beside the septum single nodes move by up to " + with_digits(moved) + " mm, the load by " +
          with_digits(loaded) +
          " mm at most: there the answer is wrong; take more nodes, or an opening farther from it"};
}

}  // namespace

Warnings warnings_of(const solve::Model& model, const Points& displacement) {
  if (model.skull || solve::mostly_prescribed(model.cloud, model.conditions)) {
    return {};
  }
  return {"nothing but the load holds the brain, so all of it follows the opening (half of it by more than " +
          with_digits(median(lengths_of(displacement))) +
          " mm); in a patient the skull holds it: add <contact/> (of a stage alone --skull), unless that is meant"};
}

Warnings warnings_of(const solve::Model& model, const Solution& solution) {
  constexpr double much = 3;  // degrees; measured loads of the heads at hand turn the brain by less than one
  Warnings warnings;
  if (const double angle = turn_of(solution); model.skull && angle > much) {
    warnings.push_back("the brain has turned by " + with_digits(angle) +
                       " degrees in its skull, along which it slides without friction: little resists that, so on "
                       "other nodes it may turn by as much another way; measure displacements all over the opening");
  }
  if (!solution.estimated_error.empty()) {
    const double error = quantile(solution.estimated_error, 0.95);
    const double most = quantile(lengths_of(solution.displacement), 0.95);
    if (error > most / 2) {
      warnings.push_back("the estimated error, " + with_digits(error) +
                         " mm in 95 % of the nodes, is more than half of what they move, " + with_digits(most) +
                         " mm; take more nodes");
    }
  }
  std::ranges::copy(warnings_beside_septum(model, solution.displacement), std::back_inserter(warnings));
  return warnings;
}

std::string turn_fault(const solve::Model& model, const Solution& solution) {
  constexpr double no_answer = 15;  // degrees
  const bool measured = model.conditions.measured || solve::prescribed_nodes(model.conditions).size() > 0;
  const double angle = model.skull && !measured ? turn_of(solution) : 0;
  return angle < no_answer
             ? ""
             : "the brain has turned by " + with_digits(angle) +
                   " degrees in its skull: nothing but contact without friction holds it, and what drained or swelled "
                   "went along with it; give a measured load, or a level or swelling that moves it less";
}

Warnings warnings_of_rooms(const solve::Model& model) {
  constexpr double like_fluid = 30;  // times less stiff than the stiffest
  double stiffest = 0;
  for (const auto& [label, material] : model.materials) {
    stiffest = std::max(stiffest, solve::shear_modulus(material));
  }
  Warnings warnings;
  for (const auto& [label, material] : model.materials) {
    if (model.fluid && material.room == solve::Room::none && like_fluid * solve::shear_modulus(material) < stiffest) {
      warnings.push_back("tissue " + std::to_string(label) +
                         " is as soft as fluid is modelled, and has its whole weight where the fluid has drained, so "
                         "that it sinks into itself; a ventricle is room=\"drained\" or \"full\"");
    }
  }
  return warnings;
}

Warnings warnings_of_levels(const solve::Model& model) {
  constexpr double skull = 20;  // mm that a cavity's fluid may stand above the brain
  Warnings warnings;
  if (!model.fluid) {
    return warnings;
  }
  const Eigen::Vector3d down = model.fluid->gravity.normalized();
  const Eigen::VectorXd along = model.cloud.positions * down;
  const double top = along.minCoeff();
  if (const double below = model.fluid->level - along.maxCoeff(); below > 1) {
    warnings.push_back("the fluid's surface lies " + with_digits(below) +
                       " mm below the whole brain, so that all of it has drained; a level counts along gravity: with "
                       "direction 0,0,-1 a surface at z = 10 is the level -10 (LPS)");
  }
  if (const double above = top - model.fluid->level; above > 1) {
    warnings.push_back(
        "the fluid's surface lies " + with_digits(above) +
        " mm above the whole brain, so that none has drained; is the level of this frame (LPS), and does "
        "gravity point the right way?");
  }
  const auto sinks = [&](const auto& tissue) { return tissue.second.density > model.fluid->density; };
  if (!model.fluid->gravity.isApprox(model.fluid->gravity_of_image) && std::ranges::none_of(model.materials, sinks)) {
    warnings.push_back("gravity has turned since the image, and no tissue is denser than the fluid, " +
                       with_digits(model.fluid->density) +
                       " kg/m3, so that the brain floats up where it should sink: give the tissues their densities, as "
                       "density=\"1040\" for the brain");
  }
  if (model.resection && model.resection->fluid_level && top - *model.resection->fluid_level > skull) {
    warnings.push_back("the surface of the fluid in the cavity lies " +
                       with_digits(top - *model.resection->fluid_level) +
                       " mm above the whole brain, and presses on the wall as such a column would; is the level of "
                       "this frame (LPS)?");
  }
  return warnings;
}

Warnings warnings_of_gravity(const solve::Model& model) {
  if (model.gravity.isZero() || !model.skull) {
    return {};
  }
  return {
      "gravity is the tissues' whole weight, as if the brain had not floated when it was imaged, which is further "
      "from the truth than no gravity; for a head take <gravity> with a level of the fluid"};
}

}  // namespace brainshift::pipelines
