// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solve/material/linear_elastic.hpp"
#include "solve/material/neo_hookean.hpp"
#include "solve/material/ogden.hpp"
#include "solve/material/saint_venant_kirchhoff.hpp"

namespace brainshift::solve::device {

/// One of the laws of the library, to be copied as it is: std::variant is nothing for a device.
struct Law {
  enum class Kind : std::int8_t { neo_hookean, ogden, saint_venant_kirchhoff, linear_elastic };

  Kind kind;
  union {
    NeoHookean neo_hookean;
    Ogden ogden;
    SaintVenantKirchhoff saint_venant_kirchhoff;
    LinearElastic linear_elastic;
  };

  explicit Law(const NeoHookean& law) : kind(Kind::neo_hookean), neo_hookean(law) {}
  explicit Law(const Ogden& law) : kind(Kind::ogden), ogden(law) {}
  explicit Law(const SaintVenantKirchhoff& law) : kind(Kind::saint_venant_kirchhoff), saint_venant_kirchhoff(law) {}
  explicit Law(const LinearElastic& law) : kind(Kind::linear_elastic), linear_elastic(law) {}
};

/// What `asked` returns of the law.
template <class Asked>
BRAINSHIFT_ON_DEVICE auto visit(const Law& law, const Asked& asked) {
  switch (law.kind) {
    case Law::Kind::neo_hookean:
      return asked(law.neo_hookean);
    case Law::Kind::ogden:
      return asked(law.ogden);
    case Law::Kind::saint_venant_kirchhoff:
      return asked(law.saint_venant_kirchhoff);
    default:
      return asked(law.linear_elastic);
  }
}

}  // namespace brainshift::solve::device
