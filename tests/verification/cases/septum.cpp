// SPDX-License-Identifier: GPL-3.0-or-later
//
// A block with a rigid sheet half through its middle, pressed towards the sheet and sheared along it, against finite
// elements with a contact pair on each side of the sheet.
#include <optional>

#include "tests/verification/cases/block_model.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification::septum_cases {

namespace {

Surface sheet() {
  constexpr double beyond = 12, rim = block_rim;  // mm
  const double back = block_size.y() + beyond;
  Surface surface{Points(4, 3), Triangles(2, 3)};
  surface.vertices << -beyond, -beyond, rim, rim, -beyond, rim, rim, back, rim, -beyond, back, rim;
  surface.triangles << 0, 1, 2, 0, 2, 3;
  return surface;
}

double seconds_a_step(const solve::SolveResult& result) {
  return result.measures.seconds_stepping / result.measures.steps;
}

/// In per cent of the largest displacement of the reference. deepest: bound of what lies behind its wall, mm.
std::vector<Figure> against(const std::string& load, const Eigen::RowVector3d& top, bool small, double deepest) {
  const Reference reference = read_reference("septum_" + load, "");
  solve::Model model = block_model(small ? 3.6 : 2.6, top);
  std::optional<solve::SolveResult> whole;
  if (!small) {
    whole = solved(model, steady_options());
  }
  model.septum = solve::Septum{"the sheet", sheet()};
  const solve::SolveResult result = solved(model, steady_options());
  const Differences apart = differences(result.solution, reference.positions, reference.displacement);
  const double largest = reference.displacement.rowwise().norm().maxCoeff();
  const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
  const std::string name = load + ", " + std::to_string(result.measures.nodes) + " nodes: ";
  const auto figure = [&](const std::string& what, double ours, const std::string& unit, std::optional<double> most) {
    return Figure{name + what, "", ours, unit, most, {}, reference.error, seconds};
  };
  std::vector<Figure> figures = {
      figure("95 %", 100 * apart.percentile95 / largest, "%", small ? 4 : 3),
      figure("mean", 100 * apart.mean / largest, "%", {}),
      figure("largest difference", 100 * apart.largest / largest, "%", {}),
      figure("deepest node behind its wall", result.measures.septum->largest_penetration, "mm", deepest)};
  if (whole) {
    const Differences without = differences(whole->solution, reference.positions, reference.displacement);
    figures.push_back(figure("95 % without the sheet", 100 * without.percentile95 / largest, "%", {}));
    figures.push_back(
        figure("seconds a step, with / without", seconds_a_step(result) / seconds_a_step(*whole), "", {}));
  }
  return figures;
}

}  // namespace

Outcome septum(bool small) {
  Outcome outcome{against("pressed", {0, 0, -6}, small, 0.03), {}};
  const std::vector<Figure> sheared = against("sheared", {6, 0, 0}, small, 0.003);
  outcome.figures.insert(outcome.figures.end(), sheared.begin(), sheared.end());
  return outcome;
}

}  // namespace brainshift::verification::septum_cases
