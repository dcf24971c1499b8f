// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/split_cell.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/domains.hpp"

namespace brainshift::solve::split_cell_test {

using test::Domain;
using test::domains;

constexpr double side = 40;

TEST(SplitCell, PartsFillTheCellWithItsOrientation) {
  for (const Domain& domain : domains(side)) {
    for (const std::size_t cell : {0u, 7u}) {
      const Corners corners = corners_of(domain.cells, cell);
      std::vector<WeightedPoint> whole, parts;
      gauss_points(domain.cells.kind, corners, 1, whole);
      for (const Corners& part : split_cell(domain.cells.kind, corners)) {
        gauss_points(domain.cells.kind, part, 1, parts);
        EXPECT_GT(parts.back().volume, 0) << domain.name;
      }
      double volume = 0;
      Eigen::Vector3d moment = Eigen::Vector3d::Zero();
      for (const WeightedPoint& p : parts) {
        volume += p.volume;
        moment += p.volume * p.position;
      }
      EXPECT_NEAR(volume, whole[0].volume, 1e-10 * volume) << domain.name;
      EXPECT_LE((moment - volume * whole[0].position).norm(), 1e-10 * moment.norm()) << domain.name;
    }
  }
}

}  // namespace brainshift::solve::split_cell_test
