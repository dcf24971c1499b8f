// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/interface/option_table.hpp"

namespace brainshift::solve {
namespace {

OptionTable<ShapeOptions> shape_options() {
  using Options = ShapeOptions;
  return {choice_option<Options>("basis", &Options::basis,
                                 {{"linear", Basis::linear},
                                  {"quadratic", Basis::quadratic},
                                  {"modified_quadratic", Basis::modified_quadratic}},
                                 "of the shape functions: MLS, or MMLS (modified_quadratic)"),
          choice_option<Options>("derivatives", &Options::derivatives,
                                 {{"full", Derivatives::full}, {"diffuse", Derivatives::diffuse}},
                                 "of the shape functions; diffuse is cheaper and inexact"),
          number_option<Options>(
              "dilatation", &Options::dilatation, {.low = 0, .high = 10}, "",
              "support radius / local spacing; 0: what suits the basis, 1.6 (linear) or 2.2, in a plane 1.8 or 2.4"),
          number_option<Options>("penalty", &Options::penalty, {.low = 0, .high = 1}, "",
                                 "on the quadratic terms of MMLS")};
}

OptionTable<SolveOptions> integration_options() {
  using Options = SolveOptions;
  return {
      choice_option<Options>(
          "volumetric", &Options::volumetric,
          {{"mean_dilatation", Volumetric::mean_dilatation}, {"pointwise", Volumetric::pointwise}},
          "volumetric strain energy: pressures linear over patches of a few nodes, or pointwise, the plain "
          "method, which locks"),
      number_option<Options>("nodes_per_patch", &Options::nodes_per_patch, above_zero, "",
                             "of mean_dilatation: nodes to a patch, on average"),
      choice_option<Options>("integration", &Options::integration,
                             {{"plain", Integration::plain}, {"consistent", Integration::consistent}},
                             "derivatives as they are, or corrected for cells that do not conform to the body, so that "
                             "homogeneous states are exact"),
      choice_option<Options>("imposition", &Options::imposition,
                             {{"exact", Imposition::exact}, {"simplified", Imposition::simplified}},
                             "of prescribed displacements: factorised, or lumped, which is cheaper and off by what the "
                             "next step takes back"),
      choice_option<Options>("points_per_cell", &Options::points_per_cell,
                             {{"auto", std::nullopt}, {"1", 1}, {"3", 3}, {"4", 4}, {"8", 8}},
                             "integration points a cell: hexahedra 1 or 8 (auto), tetrahedra 1 or 4 (auto); planar "
                             "cells: quadrilaterals 1 or 4 (auto), triangles 1 or 3 (auto); in adaptive integration of "
                             "each part of a cell, where auto is 1"),
      number_option<Options>("integration_tolerance", &Options::integration_tolerance, not_negative, "",
                             "of adaptive integration, relative: cells are split until their parts agree with them to "
                             "it, points_per_cell in each part; 0: in every cell"),
      number_option<Options>("integration_depth", &Options::integration_depth, {.low = 1, .high = 6}, "",
                             "of adaptive integration: how often a cell may be split"),
      choice_option<Options>(
          "precision", &Options::precision,
          {{"double", Precision::double_precision}, {"single", Precision::single_precision}},
          "of the derivatives while stepping and of the sums over pairs of points and nodes; "
          "stresses are double in any case. On the demo single is within 0.0001 mm of double. Double is "
          "taken where K of a material is over 400 µ, the largest µ over 1000 or the largest K over 40000 times the "
          "least µ (1000 times where a weight or another force acts), what is imposed over half of the body's size, or "
          "the tolerance below a hundred thousandth of it, and to go on with where relaxation is slow: 1400 steps "
          "under the whole load, of a tolerance of 0.01 mm and a displacement of 10 mm, more of smaller ones")};
}

OptionTable<SolveOptions> stepping_options() {
  using Options = SolveOptions;
  return {
      choice_option<Options>("dynamics", &Options::dynamics,
                             {{"relaxation", Dynamics::relaxation}, {"transient", Dynamics::transient}},
                             "the steady state under the full load, where relaxing materials have relaxed; or the "
                             "motion in time, with the physical mass"),
      number_option<Options>("tolerance", &Options::tolerance, above_zero, "mm",
                             "relaxation: stop when the bound of the remaining error is below this"),
      number_option<Options>("load_steps", &Options::load_steps, {.low = 1}, "",
                             "relaxation: steps over the load's curve; up to 2.2 times as many where a tissue's bulk "
                             "modulus is more than 100 times its relaxed shear modulus (a Poisson's ratio above "
                             "0.495). A body that turns unstable is tried again with five times as many, then with "
                             "linear shape functions, then in double precision"),
      choice_option<Options>("device", &Options::device,
                             {{"cpu", Device::cpu}, {"cuda", Device::cuda}, {"auto", Device::automatic}},
                             "what relaxation runs on: the processor; an NVIDIA GPU, in a program built with it; or "
                             "that where there is one that can, else the processor. A GPU does not do cuts, cavities, "
                             "septa, plane stress, swelling tissue, laws of one's own, the simplified imposition, "
                             "snapshots and more than 4096 prescribed displacements of a component. Samples of an "
                             "uncertainty are solved 32 at a time there, with at most 1024 prescribed displacements of "
                             "a component"),
      choice_option<Options>("start", &Options::start, {{"coarse", Start::coarse}, {"rest", Start::rest}},
                             "of relaxation: under the full load, as a coarse cloud's solution lies, or undeformed, "
                             "with a history of the load; also where a body is cut or snapshots are wanted"),
      number_option<Options>("time_step", &Options::time_step, not_negative, "s",
                             "transient: at most the critical one; 0: nine tenths of that"),
      number_option<Options>("damping", &Options::damping, not_negative, "1/s",
                             "transient: proportional to mass; 0: none"),
      number_option<Options>("region", &Options::region, not_negative, "mm",
                             "solve only what a coarse solution moves by more, elsewhere that is the result; 0: the "
                             "whole body"),
      number_option<Options>("max_steps", &Options::max_steps, {.low = 1}, "", "give up after so many steps"),
      number_option<Options>("snapshot_every", &Options::snapshot_every, not_negative, "",
                             "steps between displacements kept for steps.pvd, each 20th at the most, in time each "
                             "50th; 0: none")};
}

OptionTable<SolveOptions> all_options() {
  OptionTable<SolveOptions> table = of_whole<SolveOptions>(shape_options(), &SolveOptions::shape);
  append(table, integration_options());
  append(table, stepping_options());
  return table;
}

}  // namespace

const OptionTable<SolveOptions>& solve_options() {
  static const OptionTable<SolveOptions> table = all_options();
  return table;
}

const OptionTable<Resection>& resection_options() {
  static const OptionTable<Resection> table = {
      required(labels_option<Resection>("labels", &Resection::labels, "of the tissues that are taken out")),
      number_option<Resection>("pressure", &Resection::pressure, any_number, "Pa",
                               "in the cavity, on its undeformed wall"),
      number_option<Resection>("fluid_level", &Resection::fluid_level, any_number, "mm along gravity",
                               "of fluid that the cavity has for itself; needs <gravity fluid_level> or drained. "
                               "Without it the cavity is open to the fluid about the brain")};
  return table;
}

void check_options(const SolveOptions& options) {
  check_table(solve_options(), options);
}

}  // namespace brainshift::solve
