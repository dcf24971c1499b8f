// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/verification/cases/relative_figures.hpp"

namespace brainshift::verification {

std::vector<Figure> relative_figures(const solve::SolveResult& result, const Reference& reference, double most_mean) {
  const Differences apart = differences(result.solution, reference.positions, reference.displacement);
  const double largest = reference.displacement.rowwise().norm().maxCoeff();
  const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
  const std::string nodes = std::to_string(result.measures.nodes) + " nodes: ";
  const auto figure = [&](const std::string& what, double millimetres, std::optional<double> most) {
    return Figure{nodes + what, "", 100 * millimetres / largest, "%", most, {}, reference.error, seconds};
  };
  return {figure("largest difference", apart.largest, {}), figure("95 %", apart.percentile95, 2),
          figure("mean", apart.mean, most_mean)};
}

}  // namespace brainshift::verification
