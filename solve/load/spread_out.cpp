// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/spread_out.hpp"

#include <algorithm>

namespace brainshift::solve {

std::vector<Eigen::Index> spread_out(const Points& positions, Eigen::Index most) {
  std::vector<Eigen::Index> chosen = {0};
  Eigen::VectorXd distance = (positions.rowwise() - positions.row(0)).rowwise().norm();
  while (static_cast<Eigen::Index>(chosen.size()) < std::min(most, positions.rows())) {
    Eigen::Index next = 0;
    if (!(distance.maxCoeff(&next) > 0)) {
      break;
    }
    chosen.push_back(next);
    distance = distance.cwiseMin((positions.rowwise() - positions.row(next)).rowwise().norm());
  }
  return chosen;
}

}  // namespace brainshift::solve
