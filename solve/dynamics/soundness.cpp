// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/soundness.hpp"

#include <cmath>
#include <numeric>
#include <sstream>

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

std::vector<double> volumes_of_materials(const Body& body) {
  std::vector<double> volume(body.laws.elastic.size(), 0.0);
  for (const Patch& patch : body.points.patches) {
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      volume[static_cast<std::size_t>(patch.material)] += body.points.volume[static_cast<std::size_t>(p)];
    }
  }
  return volume;
}

double rounding_energy(const std::vector<double>& volume, const PointLaws& laws) {
  constexpr double tiny_strain = 1e-6;
  const std::vector<double> modulus = shear_moduli(laws);
  return tiny_strain * tiny_strain * std::inner_product(modulus.begin(), modulus.end(), volume.begin(), 0.0);
}

}  // namespace brainshift::solve
