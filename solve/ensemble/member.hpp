// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

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

/// How a member ended.
struct MemberResult {
  enum class End : std::uint8_t {
    rest,           ///< as relax() ends
    not_converged,  ///< relax() would not either: too many steps, or rounding in double precision
    left,           ///< it wants what an ensemble does not have, as double precision: relax() it alone
  };
  End end = End::left;
  NodalVectors parameters = {};  ///< û at rest, mm
  double error_bound = 0;        ///< mm
  int steps = 0;
};

}  // namespace brainshift::solve
