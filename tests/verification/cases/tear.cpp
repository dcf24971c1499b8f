// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wittek et al., figure 11: a specimen of pia-arachnoid is lengthened until it tears.
#include <cmath>

#include "solve/output/stress_strain.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"

namespace brainshift::verification::tear_cases {

namespace {

constexpr double length = 20, width = 10;  // mm

/// Ovine pia-arachnoid in tension (Conley Natividad et al. 2020, Fluids Barriers CNS 17): E = 7.7 ± 3.0 MPa, ultimate
/// stress 2.7 ± 0.76 MPa. That the material is neo-Hookean is an assumption, and nearly incompressible.
constexpr double youngs_modulus = 7.7e6, ultimate = 2.7e6;  // Pa

solve::Model specimen(double least_distance, double pulled, const solve::Rupture& rupture) {
  solve::Model model;
  model.plane = solve::Plane::stress;
  model.cloud = rectangle_cloud(length, width, least_distance, 4);
  model.conditions = test::all_free(model.cloud);
  const double edge = std::sqrt(length * width / static_cast<double>(model.cloud.size()));
  model.cells = test::rectangle_cells(static_cast<int>(std::lround(length / edge)),
                                      static_cast<int>(std::lround(width / edge)), length, width);
  model.materials[1] = {youngs_modulus, 0.49, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double x = model.cloud.positions(a, 0);
    if (x == 0 || x == length) {
      model.conditions.displacement.row(a) << (x == 0 ? 0 : pulled * length), 0, 0;
    }
  }
  model.rupture = rupture;
  model.curve = solve::LoadCurve({0, 1}, {0, 1}, solve::LoadCurve::Join::straight);
  return model;
}

/// True stress of a neo-Hookean, incompressible strip where its nominal stress is this: E/3 (λ − 1/λ²) = s, E/3 (λ² −
/// 1/λ).
double true_stress(double nominal) {
  double low = 1, high = 10;
  while (high - low > 1e-12) {
    const double stretch = (low + high) / 2;
    (youngs_modulus / 3 * (stretch - 1 / (stretch * stretch)) < nominal ? low : high) = stretch;
  }
  return nominal * low;
}

struct Torn {
  std::vector<solve::StressStrainRow> curve;
  solve::SolveResult result;
  double elongation = 0;  ///< at the largest stress
  double largest = 0;     ///< Pa
};

Torn pull_apart(double strength, double least_distance) {
  solve::Rupture rupture;
  rupture.criterion = solve::Rupture::Criterion::stress;
  rupture.strength = strength;
  rupture.scatter = 0.05;
  const solve::Model model = specimen(least_distance, 0.7, rupture);
  solve::SolveOptions options;
  options.points_per_cell = 4;
  options.load_steps = 3000;
  options.max_steps = 100000;
  Torn torn;
  torn.result = solved(model, options);
  torn.curve = solve::stress_strain(model, options.dynamics, torn.result.history);
  for (const solve::StressStrainRow& row : torn.curve) {
    if (row.stress > torn.largest) {
      torn.largest = row.stress;
      torn.elongation = row.elongation;
    }
  }
  return torn;
}

Series curve_of(const std::string& name, const Torn& torn) {
  Series series{name, {}, {}};
  for (const solve::StressStrainRow& row : torn.curve) {
    series.x.push_back(100 * row.elongation);
    series.y.push_back(row.stress / 1e6);
  }
  return series;
}

}  // namespace

Outcome tear(bool small) {
  Outcome outcome;
  Plot plot{"tear", "Pia-arachnoid: a strip lengthened until it tears", "elongation, %", "nominal stress, MPa", {}};
  const double least_distance = small ? 0.5 : 0.3;
  for (const auto& [name, strength] : {std::pair{std::string("ultimate stress taken as true: "), ultimate},
                                       {"ultimate stress taken as nominal: ", true_stress(ultimate)}}) {
    const Torn torn = pull_apart(strength, least_distance);
    const double seconds = torn.result.measures.seconds_setup + torn.result.measures.seconds_stepping;
    const auto add = [&](const std::string& what, const std::string& published, double value, const std::string& unit,
                         std::optional<double> most) {
      outcome.figures.push_back(
          {name + what, published, value, unit, most, {}, "constants from the literature", seconds});
    };
    add("elongation at tearing", "42.5 %", 100 * torn.elongation, "%", {});
    add("nominal stress at tearing", "", torn.largest / 1e6, "MPa", {});
    add("stress left in two parts / largest", "", std::abs(torn.curve.back().stress) / torn.largest, "", 0.01);
    add("length of the tear / width", "", torn.result.measures.cut->extent / width, "", {});
    plot.series.push_back(curve_of(name.substr(0, name.size() - 2), torn));
    if (small) {
      break;
    }
  }
  outcome.plots.push_back(plot);
  return outcome;
}

}  // namespace brainshift::verification::tear_cases
