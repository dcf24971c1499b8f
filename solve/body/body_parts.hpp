// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "solve/body/ordered_cloud.hpp"
#include "solve/boundary/patch_rim.hpp"
#include "solve/boundary/wall_load.hpp"
#include "solve/material/material_table.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/quadrature/pressure_patches.hpp"
#include "solve/shape/shape_rows.hpp"

namespace brainshift::solve {

/// Forces on the wall of a cavity.
struct WallLoad {
  PlacedForces forces;
  ShapeRows rows;  ///< at their places
};

/// What a body is laid out from. Kept where cuts go on, as each advance lays it out anew.
struct BodyParts {
  OrderedCloud cloud;
  ShapeRows nodal_rows;  ///< at the nodes, without derivatives
  PatchRim rim = {};     ///< of what is prescribed
  ShapeRows inner_rows;  ///< at the measured points inside the body; none: empty
  IntegrationPoints points;
  ShapeRows point_rows;  ///< with derivatives
  PressurePatches patches;
  MaterialTable materials;
  std::vector<std::vector<std::int32_t>> stiff_parts = {};  ///< nodes of each; see stiff_parts()
  std::vector<double> node_modulus = {};                    ///< moduli_at_nodes(), Pa; none: all see each other
  std::optional<WallLoad> wall_load = {};                   ///< of a cavity that something presses in
};

}  // namespace brainshift::solve
