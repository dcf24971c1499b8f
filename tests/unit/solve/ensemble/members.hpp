// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/ensemble/each.hpp"
#include "solve/force/point_laws.hpp"
#include "solve/material/elastic_law.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve {

/// Laws of as many members as asked for, of materials that differ from member to member.
inline std::vector<PointLaws> differing_laws(std::vector<Material> materials, std::size_t count) {
  std::vector<PointLaws> laws;
  for (std::size_t m = 0; m < count; ++m) {
    PointLaws& of_member = laws.emplace_back();
    for (Material& material : materials) {
      material.youngs_modulus *= 1.07;
      for (OgdenTerm& term : material.ogden) {
        term.shear_modulus *= 1.07;
      }
      material.poisson_ratio -= 0.004;
      of_member.elastic.push_back(elastic_law(material));
    }
  }
  return laws;
}

/// Members' parameters, each its own, mm; those that are not there stay at zero.
inline EachVectors differing_parameters(const Specimen& body, double amplitude, std::size_t count) {
  EachVectors vectors(body.cloud.size(), VectorOfEach<double>{});
  for (std::size_t m = 0; m < count; ++m) {
    set_member(body.random_parameters(amplitude, static_cast<unsigned>(m) + 1), m, vectors);
  }
  return vectors;
}

}  // namespace brainshift::solve
