// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "solve/interface/shape_options.hpp"

namespace brainshift::solve {

/// How the volumetric part of the strain energy is integrated.
enum class Volumetric : std::uint8_t {
  mean_dilatation,  ///< pressures linear over patches of a few nodes, pressure_patches.hpp: no volumetric locking
  pointwise,        ///< the plain method
};

/// Whether derivatives are corrected for background cells that do not conform to the body.
enum class Integration : std::uint8_t {
  plain,
  consistent,  ///< make_derivatives_consistent(): homogeneous states are exact
};

/// How essential conditions are imposed, EssentialConditions. The simplified form lumps V M⁻¹ Vᵀ into the row sums of
/// |V| M⁻¹ |V|ᵀ: nothing to factorise, but at rest V û differs from ū by what the next step takes back.
enum class Imposition : std::uint8_t { exact, simplified };

/// Of the derivatives of the shape functions while stepping, most of what a step reads, and of the sums over pairs of
/// points and nodes. Stresses are double in any case.
enum class Precision : std::uint8_t { double_precision, single_precision };

/// What time stepping is for.
enum class Dynamics : std::uint8_t {
  relaxation,  ///< the steady state under the full load: adaptive dynamic relaxation
  transient,   ///< the motion in time, with the physical mass
};

/// Where relaxation begins.
enum class Start : std::uint8_t {
  rest,    ///< undeformed; the load comes over load_steps
  coarse,  ///< under the full load, as a coarse cloud's solution lies: fewer steps to the same end, no way there
};

/// What relaxation runs on.
enum class Device : std::uint8_t {
  cpu,
  cuda,       ///< the first GPU that CUDA finds; what it cannot do is an error
  automatic,  ///< that GPU for what it can do, the CPU for what it cannot
};

/// What each may be stands in option_table.cpp.
struct SolveOptions {
  ShapeOptions shape;  ///< planar is set from the model
  Volumetric volumetric = Volumetric::mean_dilatation;
  double nodes_per_patch = 8;  ///< of mean dilatation
  Integration integration = Integration::consistent;
  double consistency_defect = 1e-5;  ///< what may be left of the mean Σ w |B_a|, make_derivatives_consistent()
  Imposition imposition = Imposition::exact;
  double integration_tolerance = 0;                   ///< τ of adaptive_points(); 0: points_per_cell in every cell
  int integration_depth = 3;                          ///< of adaptive_points()
  Precision precision = Precision::double_precision;  ///< of derivatives, sums over pairs, forces of points
  /// Of integration, or of a part of a cell: hexahedra 1 or 8, tetrahedra and quads 1 or 4, triangles 1 or 3. Absent:
  /// the most; 1 where integration is adaptive.
  std::optional<int> points_per_cell = {};
  Dynamics dynamics = Dynamics::relaxation;
  /// Relaxation: stop when the bound of the remaining error is below this, mm, and below 1/50 of the displacement.
  double tolerance = 0.01;
  int load_steps = 400;  ///< relaxation: steps over the load's curve; more by steps_of_load(), or where a body may tear
  /// Relaxation of a whole body in space. A coarse start is one from Model::last where there is one. It is one from
  /// rest all the same for a body that is cut or torn, where snapshots are wanted or the load's curve does not end at
  /// 1; and without a last state for a body that is resected or parted by a septum, and where the coarse cloud cannot
  /// be solved or its solution does not hold.
  Start start = Start::rest;
  double time_step = 0;  ///< transient: s; 0: nine tenths of the critical one
  double damping = 0;    ///< transient: c of METHOD.md (20), 1/s
  int max_steps = 50000;
  Device device = Device::cpu;  ///< of relaxation, device/README.md
  double region = 0;  ///< mm; only what a coarse solution moves by more is solved, region.hpp; 0: the whole body
  int snapshot_every =
      0;  ///< steps between displacements kept for steps.pvd, each 20th at the most, in time each 50th; 0: none
};

}  // namespace brainshift::solve
