// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/elastic_law.hpp"

#include <stdexcept>

namespace brainshift::solve {

ElasticLaw elastic_law(const Material& material) {
  switch (material.law) {
    case Law::neo_hookean:
      return NeoHookean(material);
    case Law::ogden:
      return Ogden(material);
    case Law::saint_venant_kirchhoff:
      return SaintVenantKirchhoff(material);
    case Law::linear_elastic:
      return LinearElastic(material);
    case Law::own:
      return OwnLaw(material);
  }
  throw std::invalid_argument("the material has a law that does not exist");
}

}  // namespace brainshift::solve
