// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/material/material_table.hpp"
#include "solve/ordered_cloud.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/quadrature/pressure_patches.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// What a model is made of before it is laid out for stepping.
struct Pieces {
  OrderedCloud cloud;
  ShapeRows nodal_rows;  ///< at the nodes, without derivatives
  IntegrationPoints points;
  ShapeRows point_rows;  ///< with derivatives
  PressurePatches patches;
  MaterialTable materials;

  std::size_t held_bytes() const {
    return cloud_bytes(cloud) + nodal_rows.held_bytes() + point_rows.held_bytes() + points.held_bytes() +
           bytes(patches.order) + bytes(patches.begin) + bytes(materials.row_of_point);
  }
};

}  // namespace brainshift::solve
