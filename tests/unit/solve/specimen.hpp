// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numeric>
#include <vector>

#include "solve/arrays/nodal_vectors.hpp"
#include "solve/force/internal_force.hpp"
#include "solve/material/elastic_law.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve {

struct SpecimenOptions {
  Basis basis = Basis::linear;
  double nodes_per_patch = 6;  ///< 0: single points
  int points_per_cell = 8;
  bool plane_stress = false;
  Precision precision = Precision::double_precision;
};

/// A cloud with cells and materials, and all that internal_force() needs. Of two materials the second has the end at
/// large x.
struct Specimen {
  NodeCloud cloud;
  PointLaws laws;
  PointBlocks points;
  ForceScratch scratch;

  Specimen(const NodeCloud& given, const BackgroundCells& cells, const std::vector<Material>& materials,
           const SpecimenOptions& options)
      : cloud(given),
        laws(laws_of(materials, options.plane_stress)),
        points(blocks(given, cells, materials.size(), options)),
        scratch(points, laws) {}

  NodalVectors force(const NodalVectors& parameters) {
    NodalVectors f(parameters.size());
    internal_force(points, laws, parameters, scratch, f);
    return f;
  }
  double energy(const NodalVectors& parameters) {
    force(parameters);
    return point_state(points, laws, scratch).strain_energy;
  }
  NodalVectors rest() const { return NodalVectors(4 * cloud.size(), 0.0); }

  /// û_a = h X_a, which is the displacement too.
  NodalVectors linear(const Eigen::Matrix3d& h) const {
    NodalVectors u = rest();
    for (std::size_t a = 0; a < cloud.size(); ++a) {
      at(u, a).head<3>() = h * cloud.positions.row(static_cast<Eigen::Index>(a)).transpose();
    }
    return u;
  }
  /// Each component within ± amplitude, mm; in the plane z stays 0.
  NodalVectors random_parameters(double amplitude, unsigned seed = 3) const {
    const Points random = test::random_points(static_cast<int>(cloud.size()), 2, seed);
    const bool planar = cloud.positions.col(2).isZero();
    NodalVectors u = rest();
    for (std::size_t a = 0; a < cloud.size(); ++a) {
      for (int i = 0; i < (planar ? 2 : 3); ++i) {
        at(u, a)[i] = amplitude * (random(static_cast<Eigen::Index>(a), i) - 1);
      }
    }
    return u;
  }

 private:
  static PointLaws laws_of(const std::vector<Material>& materials, bool plane_stress) {
    PointLaws laws;
    for (const Material& m : materials) {
      laws.elastic.push_back(elastic_law(m));
      if (m.swelling != 0) {
        laws.swelling.resize(materials.size(), 0.0);
        laws.swelling[laws.elastic.size() - 1] = m.swelling;
      }
    }
    laws.plane_stress = plane_stress;
    return laws;
  }
  static PointBlocks blocks(const NodeCloud& cloud, const BackgroundCells& cells, std::size_t materials,
                            const SpecimenOptions& options) {
    const IntegrationPoints where = integration_points(cells, options.points_per_cell, nullptr, {1});
    const double border = materials > 1 ? 0.62 * cloud.positions.col(0).maxCoeff() : 1e9;
    const double total = std::accumulate(where.volume.begin(), where.volume.end(), 0.0);
    std::vector<std::int32_t> material;
    std::vector<double> share;
    for (std::size_t p = 0; p < where.size(); ++p) {
      material.push_back(where.positions(static_cast<Eigen::Index>(p), 0) > border ? 1 : 0);
      share.push_back(where.volume[p] / total * static_cast<double>(cloud.size()));
    }
    const ShapeFunctions shape(cloud.positions, cloud.spacing,
                               {.basis = options.basis, .planar = is_planar(cells.kind)});
    return point_blocks(where, shape.evaluate(where.positions, true), material, cloud.size(),
                        pressure_patches(where.positions, share, material, options.nodes_per_patch), options.precision);
  }
};

inline double largest(const NodalVectors& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())).cwiseAbs().maxCoeff();
}

inline Eigen::Vector3d resultant(const NodalVectors& force) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t a = 0; a < force.size() / 4; ++a) {
    sum += at(force, a).head<3>();
  }
  return sum;
}

}  // namespace brainshift::solve
