// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/nodal_vectors.hpp"
#include "solve/boundary/external_force.hpp"
#include "solve/force/point_laws.hpp"

namespace brainshift::solve {

/// One of several loads of a body.
struct Member {
  PointLaws laws;                    ///< with the rows of the body's
  ExternalForce external;            ///< as the body's
  Points prescribed = Points(0, 3);  ///< (n × 3) mm, one row a node of the body, NaN where the body's conditions are
                                     ///< free; no rows: as the body's conditions have it
  NodalVectors start = {};           ///< as Course::start
};

}  // namespace brainshift::solve
