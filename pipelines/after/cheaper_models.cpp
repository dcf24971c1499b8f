// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/after/cheaper_models.hpp"

#include <algorithm>
#include <map>
#include <sstream>

namespace brainshift::pipelines {
namespace {

using solve::Model;
using solve::SolveOptions;

/// Above it small strains are not worth a try: they are off by the strain's square.
constexpr double small_stretch = 1.1;

/// The tissue of most cells.
std::int32_t largest_tissue(const Model& model) {
  std::map<std::int32_t, std::size_t> cells;
  for (const std::int32_t label : model.cells.label) {
    cells[label] += model.materials.contains(label) ? 1 : 0;
  }
  return std::max_element(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

template <class Is>
bool any_material(const Model& model, const Is& is) {
  return std::any_of(model.materials.begin(), model.materials.end(), [&](const auto& m) { return is(m.second); });
}

void add_resection(const solve::Resection& resection, std::vector<CheaperModel>& found) {
  found.push_back({"resection", "left out", "", [](Model& m, SolveOptions&) { m.resection.reset(); }});
  if (resection.wall) {
    found.push_back({"wall of the resection", "where labels change", "", [](Model& m, SolveOptions&) {
                       m.resection->wall.reset();
                       m.resection->fluid_level.reset();  // it needs a wall to press on
                     }});
  }
}

void add_parts_of_the_model(const Model& model, const SolveOptions& options, std::vector<CheaperModel>& found) {
  if (model.skull) {
    found.push_back({"contact", "left out", "", [](Model& m, SolveOptions&) { m.skull.reset(); }});
  }
  if (model.septum) {
    found.push_back({"septum", "left out", "", [](Model& m, SolveOptions&) { m.septum.reset(); }});
  }
  if (!model.gravity.isZero()) {
    found.push_back({"gravity", "left out", "", [](Model& m, SolveOptions&) { m.gravity.setZero(); }});
  }
  if (model.fluid) {
    found.push_back({"drained fluid", "left out", "", [](Model& m, SolveOptions&) {
                       m.fluid.reset();
                       if (m.resection) {
                         m.resection->fluid_level.reset();  // it goes by the fluid's gravity
                       }
                     }});
  }
  if (model.resection) {
    add_resection(*model.resection, found);
  }
  if (any_material(model, [](const solve::Material& m) { return m.swelling != 0; })) {
    found.push_back({"swelling", "left out", "", [](Model& m, SolveOptions&) {
                       for (auto& [label, material] : m.materials) {
                         material.swelling = 0;
                       }
                     }});
  }
  if (model.materials.size() > 1) {
    const std::int32_t label = largest_tissue(model);
    found.push_back({"materials of their own", "all tissues as tissue " + std::to_string(label), "",
                     [label](Model& m, SolveOptions&) {
                       const solve::Material one = m.materials.at(label);
                       for (auto& [other, material] : m.materials) {
                         material = one;
                       }
                     }});
  }
  const bool in_time = options.dynamics == solve::Dynamics::transient;
  if (in_time && any_material(model, [](const solve::Material& m) { return !m.prony.empty(); })) {
    found.push_back({"relaxation of the materials", "left out", "", [](Model& m, SolveOptions&) {
                       for (auto& [label, material] : m.materials) {
                         material.prony.clear();
                       }
                     }});
  }
}

CheaperModel small_strains(double largest_stretch) {
  std::ostringstream why;
  if (largest_stretch > small_stretch) {
    why << "not tried: the largest stretch was " << largest_stretch << ", and small strains go to about "
        << small_stretch;
  }
  return {"large strains", "linear_elastic", why.str(), [](Model& m, SolveOptions&) {
            for (auto& [label, material] : m.materials) {
              material = solve::linearised(material);
            }
          }};
}

}  // namespace

std::vector<CheaperModel> cheaper_models(const Model& model, const SolveOptions& options, double largest_stretch) {
  std::vector<CheaperModel> found;
  add_parts_of_the_model(model, options, found);
  if (any_material(model, [](const solve::Material& m) { return m.law != solve::Law::linear_elastic; })) {
    found.push_back(small_strains(largest_stretch));
  }
  if (options.imposition == solve::Imposition::exact) {
    found.push_back({"exact imposition", "simplified", "",
                     [](Model&, SolveOptions& o) { o.imposition = solve::Imposition::simplified; }});
  }
  if (options.shape.basis != Basis::linear) {
    found.push_back(
        {"quadratic shape functions", "linear", "", [](Model&, SolveOptions& o) { o.shape.basis = Basis::linear; }});
  }
  if (options.precision == solve::Precision::double_precision) {
    found.push_back({"double precision", "single", "",
                     [](Model&, SolveOptions& o) { o.precision = solve::Precision::single_precision; }});
  }
  return found;
}

}  // namespace brainshift::pipelines
