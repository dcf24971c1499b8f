// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>
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

/// µ of each row, Pa.
inline std::vector<double> shear_moduli(const PointLaws& laws) {
  std::vector<double> moduli;
  for (const ElasticLaw& elastic : laws.elastic) {
    moduli.push_back(std::visit([](const auto& law) { return double{law.shear_modulus}; }, elastic));
  }
  return moduli;
}

}  // namespace brainshift::solve
