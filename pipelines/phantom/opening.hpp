// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/phantom/head.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::pipelines {

/// The opening in the skull over the tumour, and how far the brain sinks there.
struct Opening {
  Eigen::Vector3d centre;  ///< on the brain's surface, mm LPS
  Eigen::Vector3d normal;  ///< of the brain's surface there, outward
  double radius;           ///< mm
  double depth;            ///< inward displacement at the centre, mm
};

/// 26 mm wide to each side and 8 mm deep in a head of scale 1.
Opening make_opening(const Head& head);

/// What would be measured: points on the exposed cortex, moved inward along the opening's normal, most at the centre
/// and little at the rim: depth · (1 + cos(0.8 π r / radius)) / 2.
solve::CraniotomyLoad measured_load(const Head& head, const Opening& opening);

}  // namespace brainshift::pipelines
