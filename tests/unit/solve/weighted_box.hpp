// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "solve/arrays/nodal_vectors.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve {

/// An irregular box of 40 mm whose nodes differ in mass, with its shape functions at the nodes.
struct WeightedBox {
  NodeCloud nodes = test::irregular_box(7, 40);
  ShapeFunctions shape{nodes.positions, nodes.spacing, {}};
  ShapeRows rows = shape.evaluate(nodes.positions, false);
  std::vector<double> mass = masses();

  std::vector<double> masses() const {
    std::vector<double> m;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      m.push_back(1 + 0.5 * std::sin(static_cast<double>(a)));
    }
    return m;
  }
  NodalVectors shifted(const Eigen::Vector3d& by) const {
    NodalVectors u(4 * nodes.size(), 0.0);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      at(u, a).head<3>() = by;
    }
    return u;
  }
  /// Of what moves nodes from where they would be freely, along the way from where they were.
  double push_work(const NodalVectors& before, const NodalVectors& free, const NodalVectors& after) const {
    double work = 0;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      work += mass[a] * (at(after, a) - at(free, a)).dot(at(after, a) - at(before, a)) / 2;
    }
    return work;
  }
  NodalVectors random_parameters(double amplitude) const {
    const Points random = test::random_points(static_cast<int>(nodes.size()), 2 * amplitude);
    NodalVectors u(4 * nodes.size(), 0.0);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      Eigen::Vector3d::Map(&u[4 * a]) =
          random.row(static_cast<Eigen::Index>(a)).transpose() - Eigen::Vector3d::Constant(amplitude);
    }
    return u;
  }
  Points displacement(const NodalVectors& u) const {
    Points parameters(nodes.positions.rows(), 3);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      parameters.row(static_cast<Eigen::Index>(a)) = Eigen::Vector3d::Map(&u[4 * a]);
    }
    return shape.interpolate(nodes.positions, parameters);
  }
};

}  // namespace brainshift::solve
