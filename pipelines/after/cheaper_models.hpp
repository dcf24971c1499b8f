// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solve/solve.hpp"

namespace brainshift::pipelines {

/// A model without one of its parts, or with the cheaper one in its place.
struct CheaperModel {
  std::string part;       ///< "contact"
  std::string change;     ///< "left out", "linear shape functions"
  std::string not_tried;  ///< why it is not worth a try; empty: it is
  std::function<void(solve::Model&, solve::SolveOptions&)> make;
};

/// Those of a model's parts that can be left out or made cheaper, one at a time. largest_stretch: of its solution,
/// which says whether small strains are worth a try.
std::vector<CheaperModel> cheaper_models(const solve::Model& model, const solve::SolveOptions& options,
                                         double largest_stretch);

}  // namespace brainshift::pipelines
