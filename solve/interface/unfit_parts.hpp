// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// A part of a model that may be there, and its name.
using UnfitPart = std::pair<bool, const char*>;

/// Throws std::invalid_argument with the first of the parts that is there: "<what> with <part>; <advice>".
inline void refuse_unfit(const std::string& what, const std::vector<UnfitPart>& parts, const std::string& advice) {
  for (const auto& [there, name] : parts) {
    if (there) {
      throw std::invalid_argument(what + " with " + name + "; " + advice);
    }
  }
}

/// What goes beyond one body in space that comes to rest.
inline std::vector<UnfitPart> beyond_rest(const Model& model, const SolveOptions& options) {
  return {
      {options.dynamics == Dynamics::transient, "motion in time"},
      {options.region > 0, "a region"},
      {!model.cuts.empty() || model.rupture, "cuts and tears"},
      {model.septum.has_value(), "a septum"},
      {model.resection.has_value(), "a resection"},
      {model.plane != Plane::none, "a plane problem"},
  };
}

}  // namespace brainshift::solve
