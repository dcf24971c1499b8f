// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numeric>

#include "solve/body/body.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve {

/// A specimen as stepping takes it: nothing holds or pushes it.
inline Body free_body(const Specimen& specimen) {
  Body body;
  body.original.resize(specimen.cloud.size());
  std::iota(body.original.begin(), body.original.end(), 0);
  body.points = specimen.points;
  body.laws = specimen.laws;
  return body;
}

}  // namespace brainshift::solve
