// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "solve/body/forces.hpp"
#include "solve/body/lay_out.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/ensemble/relax_together.hpp"
#include "solve/interface/constants.hpp"
#include "solve/material/named_materials.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/prepare.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/noisy_nodes.hpp"

namespace brainshift::solve {

/// A block whose upper face is pressed down within a skull that its sides come to touch, under its weight.
struct Pressed {
  Model model = box_model(test::box_cells(5, model_side), 6);
  SolveOptions options;
  Prepared prepared;

  explicit Pressed(double tolerance) {
    for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
      const double z = model.cloud.positions(a, 2);
      if (z < 1e-9 || z > model_side - 1e-9) {
        model.conditions.displacement.row(a) << 0, 0, z < 1e-9 ? 0 : -6;
      }
    }
    model.skull = test::box(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(model_side + 1));
    model.gravity = {0, 3, 0};
    options.shape.basis = Basis::linear;
    options.load_steps = 20;
    options.precision = Precision::single_precision;  // where the tolerance allows it
    options.tolerance = tolerance;
    options = completed(options, model);
    SolveMeasures measures;
    prepared = prepare(model, options, {}, measures, {}, true);
  }
  const Body& body() const { return prepared.body; }
  void make_noisy() {
    const BodyParts& parts = *prepared.parts;
    const Points& prescribed = parts.cloud.conditions.displacement;
    prepared.body.essential = EssentialConditions(prescribed, parts.nodal_rows, parts.cloud.original,
                                                  noisy_nodes(prescribed.rows(), 1e-3), ShapeRows());
  }
  /// Two nodes with the row of one: conditions that repeat each other.
  void repeat_conditions() {
    const BodyParts& parts = *prepared.parts;
    ShapeRows repeated;
    for (std::size_t a = 0; a < parts.nodal_rows.size(); ++a) {
      repeated.append(parts.nodal_rows[a / 2]);
    }
    prepared.body.essential =
        EssentialConditions(Points::Constant(parts.cloud.positions.rows(), 3, 0.1), repeated, parts.cloud.original);
  }
  Constants constants(std::size_t member) const {
    const auto m = static_cast<double>(member);
    Constants c{.materials = model.materials, .gravity = model.gravity, .fluid = {}};
    c.materials[1].youngs_modulus *= std::exp(0.1 * (m - 3));
    c.materials[1].poisson_ratio = 0.42 + 0.015 * m;
    c.gravity = Eigen::Vector3d(m, 3 - m, 0.5);
    return c;
  }
  std::vector<Member> loads(std::size_t count) const {
    std::vector<Member> result;
    for (std::size_t m = 0; m < count; ++m) {
      const Model with = with_constants(model, constants(m));
      result.push_back({.laws = laws_with(body(), with.materials),
                        .external = external_force(with, *prepared.parts, Dynamics::relaxation)});
    }
    return result;
  }
  /// Of Ogden tissue, which then has a stiffness that is no number.
  std::vector<Member> loads_of_which_the_last_starts_inside_out(std::size_t count) const {
    std::vector<Member> result = loads(count);
    for (Member& load : result) {
      load.laws = laws_with(body(), {{1, named_material("brain_ogden").value()}});
      load.start.assign(4 * body().nodes(), 0.0);
    }
    for (std::size_t a = 0; a < body().nodes(); ++a) {
      at(result.back().start, a).head<3>() = -1.5 * body().positions.row(body().original[a]).transpose();
    }
    return result;
  }
  /// Of a member by itself; by û, as devices do.
  SteppingResult alone(const Member& load, const NodalVectors& start) const {
    Body of_member = body();
    of_member.laws = load.laws;
    of_member.external = load.external;
    return relax(std::move(of_member), {.curve = model.curve, .start = start, .bound = BoundOf::parameters}, options,
                 {});
  }
  std::vector<MemberResult> together(const std::vector<Member>& loads) const {
    return relax_together(body(), loads, model.curve, options, {}, false, BoundOf::parameters);
  }
};

}  // namespace brainshift::solve
