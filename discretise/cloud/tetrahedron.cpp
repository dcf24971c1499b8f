// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/tetrahedron.hpp"

#include <Eigen/LU>
#include <cmath>

namespace brainshift::discretise {

TetrahedronCorners corners_of(const Points& nodes, const std::array<std::int32_t, 4>& tetrahedron) {
  TetrahedronCorners x;
  for (std::size_t k = 0; k < 4; ++k) {
    x.row(static_cast<Eigen::Index>(k)) = nodes.row(tetrahedron[k]);
  }
  return x;
}

double volume_of(const TetrahedronCorners& x) {
  const Eigen::Matrix3d edges = x.bottomRows<3>().rowwise() - x.row(0);
  return edges.determinant() / 6;
}

double mean_edge(const TetrahedronCorners& x) {
  double squares = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b) {
      squares += (x.row(a) - x.row(b)).squaredNorm();
    }
  }
  return std::sqrt(squares / 6);
}

double shape_quality(const TetrahedronCorners& x) {
  return volume_of(x) * 6 * std::sqrt(2.0) / std::pow(mean_edge(x), 3);
}

}  // namespace brainshift::discretise
