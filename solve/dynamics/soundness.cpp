// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/soundness.hpp"

#include <cmath>
#include <sstream>
#include <variant>

namespace brainshift::solve {

std::string unsound(const PointState& state, double moved) {
  if (!std::isfinite(moved)) {
    return "displacements are no longer finite";
  }
  if (!(state.smallest_jacobian > 0)) {
    std::ostringstream text;
    text << "an integration point turned inside out (J = " << state.smallest_jacobian << ")";
    return text.str();
  }
  return {};
}

void mark_unstable(const std::string& why, double time, double fraction, const Fault& fault, SteppingResult& result) {
  std::ostringstream text;
  text << "unstable at step " << result.steps << " (time " << time << ") with " << 100 * fraction
       << " % of the load: " << why;
  result.failure = text.str();
  result.unstable = true;
  result.fault = fault;
  result.fault->fast = result.history.empty() ||  // within the first window
                       result.history.back().kinetic_energy > result.history.back().strain_energy;
}

std::string unbalanced(const HistoryRow& row) {
  std::ostringstream text;
  text << "the work of " << row.external_work << " mJ has become " << row.strain_energy << " mJ of strain, "
       << row.kinetic_energy << " mJ of motion and " << row.dissipated_energy
       << " mJ in the damping, which is not the same, most of all";
  return text.str();
}

double rounding_energy(const Body& body) {
  double stiffness = 0;
  for (const Patch& patch : body.points.patches) {
    const double modulus = std::visit([](const auto& law) { return law.shear_modulus; },
                                      body.laws.elastic[static_cast<std::size_t>(patch.material)]);
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      stiffness += modulus * body.points.volume[static_cast<std::size_t>(p)];
    }
  }
  return 1e-12 * stiffness * energy_unit;
}

}  // namespace brainshift::solve
