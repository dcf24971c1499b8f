// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/material/elastic_law.hpp"
#include "solve/material/viscous.hpp"

namespace brainshift::solve {

/// How the points answer deformation. The rows are those of the material table; a patch is of one row, and its law is
/// resolved once.
struct PointLaws {
  std::vector<ElasticLaw> elastic;
  std::vector<PronyStep> prony = {};  ///< one a row in a transient run where some material relaxes, else empty
  std::vector<double> swelling = {};  ///< one a row, Material::swelling; empty: none
  bool plane_stress = false;          ///< F_33 follows from P_33 = 0; patches are then single points
  bool in_time = false;               ///< a transient run: it follows how fast J falls at each point
};

}  // namespace brainshift::solve
