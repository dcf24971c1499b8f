// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/joined_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace brainshift::solve {

namespace {

using Cells = std::map<std::array<double, 3>, std::vector<Eigen::Index>>;

Cells cells_of(const Points& positions, double edge) {
  Cells cells;
  for (Eigen::Index p = 0; p < positions.rows(); ++p) {
    const Eigen::RowVector3d x = positions.row(p);
    const Eigen::RowVector3d at = edge > 0 ? (x / edge).array().floor().matrix().eval() : x;
    cells[{at[0], at[1], at[2]}].push_back(p);
  }
  return cells;
}

}  // namespace

std::vector<Eigen::Index> rows_but(const std::vector<Eigen::Index>& these, Eigen::Index all) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < all; ++row) {
    if (!std::ranges::binary_search(these, row)) {
      rows.push_back(row);
    }
  }
  return rows;
}

std::vector<std::vector<Eigen::Index>> joined_rows(const Points& positions, int most) {
  constexpr double finest = 1;  // mm
  Cells cells = cells_of(positions, 0);
  for (double edge = finest; static_cast<int>(cells.size()) > most; edge *= std::cbrt(2.0)) {
    cells = cells_of(positions, edge);
  }
  std::vector<std::vector<Eigen::Index>> rows;
  for (auto& [place, members] : cells) {
    rows.push_back(std::move(members));
  }
  return rows;
}

CraniotomyLoad joined(const CraniotomyLoad& load, int most) {
  const std::vector<std::vector<Eigen::Index>> rows = joined_rows(load.positions, most);
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count == load.positions.rows()) {
    return load;
  }
  CraniotomyLoad joint{Points(count, 3), Points(count, 3), Points(count, 3)};
  for (Eigen::Index row = 0; row < count; ++row) {
    const std::vector<Eigen::Index>& members = rows[static_cast<std::size_t>(row)];
    const Points weight = load.sigma(members, Eigen::all).array().square().inverse();
    const Eigen::RowVector3d total = weight.colwise().sum();
    const Points u = load.displacement(members, Eigen::all);
    joint.positions.row(row) = load.positions(members, Eigen::all).colwise().mean();
    joint.displacement.row(row) = weight.cwiseProduct(u).colwise().sum().cwiseQuotient(total);
    joint.sigma.row(row) = total.cwiseInverse().cwiseSqrt();
  }
  return joint;
}

}  // namespace brainshift::solve
