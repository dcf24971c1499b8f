// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/viscous.hpp"

#include <cmath>

namespace brainshift::solve {

namespace {

using Symmetric = Eigen::Matrix<double, 6, 1>;

Symmetric packed(const Eigen::Matrix3d& s) {
  return Symmetric{s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2)};
}

Eigen::Matrix3d unpacked(const Symmetric& s) {
  return Eigen::Matrix3d{{s[0], s[3], s[4]}, {s[3], s[1], s[5]}, {s[4], s[5], s[2]}};
}

}  // namespace

PronyStep::PronyStep(std::span<const PronyTerm> prony, double time_step) : lasting(1) {
  for (const PronyTerm& term : prony) {
    const double ratio = time_step / term.time;
    const double decay = std::expm1(-ratio);
    terms.push_back({term.share, decay, -decay / ratio});
    lasting -= term.share;
  }
}

Eigen::Matrix3d relaxed_stress(const PronyStep& step, const Eigen::Matrix3d& isochoric_stress, const Deformation& d,
                               std::span<double> state) {
  const Symmetric elastic = packed(d.cofactor.transpose() * isochoric_stress / d.jacobian);  // S0 = F⁻¹ P
  Eigen::Map<Symmetric> last(state.data());
  const Symmetric change = elastic - last;
  last = elastic;
  Symmetric stress = step.lasting * elastic;
  double* entry = state.data();
  for (const PronyStep::Term& term : step.terms) {
    entry += 6;
    Eigen::Map<Symmetric> overstress(entry);
    overstress += term.decay * overstress + term.response * change;
    stress += term.share * overstress;
  }
  return d.gradient * unpacked(stress);
}

}  // namespace brainshift::solve
