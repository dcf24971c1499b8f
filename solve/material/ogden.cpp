// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/ogden.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace brainshift::solve {

Ogden::Ogden(const Material& material)
    : shear_modulus(solve::shear_modulus(material)),
      bulk_modulus(solve::bulk_modulus(material)),
      count_(material.ogden.size()) {
  if (count_ == 0 || count_ > capacity) {
    throw std::invalid_argument("Ogden's law takes 1 to " + std::to_string(capacity) + " terms, not " +
                                std::to_string(count_));
  }
  std::copy(material.ogden.begin(), material.ogden.end(), terms_.begin());
}

}  // namespace brainshift::solve
