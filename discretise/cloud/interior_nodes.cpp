// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/interior_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "discretise/cloud/dart_grid.hpp"
#include "discretise/cloud/smoothing.hpp"

namespace brainshift::discretise {
namespace {

constexpr int smoothing_sweeps = 5;
constexpr int shaking_sweeps = 4;
/// Random places at this fraction of the spacing nearly fill space at the density that is wanted.
constexpr double first_distance = 0.86;
/// Misses in a row, in counts of nodes wanted, after which the distance is lowered.
constexpr std::size_t patience = 8;
/// Lines a side on which the volume's demand is summed.
constexpr int demand_lines = 96;

}  // namespace

Points fill_interior(const Points& surface_nodes, const Scanlines& body, const SizingField& sizing, double spacing,
                     std::size_t count, Random& random) {
  const Eigen::Vector3d low = surface_nodes.colwise().minCoeff();
  const Eigen::Vector3d high = surface_nodes.colwise().maxCoeff();
  DartGrid darts(low, high, first_distance * spacing);
  const Eigen::Index on_surface = surface_nodes.rows();
  Points nodes(on_surface + static_cast<Eigen::Index>(count), 3);
  nodes.topRows(on_surface) = surface_nodes;
  for (Eigen::Index node = 0; node < on_surface; ++node) {
    darts.accept(surface_nodes.row(node));
  }
  const double finest = sizing.smallest();
  double fraction = first_distance;
  std::size_t misses = 0;
  for (Eigen::Index next = on_surface; next < nodes.rows();) {
    const Eigen::Array3d u(random.uniform(), random.uniform(), random.uniform());
    const Eigen::Vector3d x = low + ((high - low).array() * u).matrix();
    const double factor = sizing.factor(x);
    const bool wanted = random.uniform() <= std::pow(finest / factor, 3);
    if (wanted && darts.is_free(x, fraction * factor * spacing) && body.inside(x)) {
      darts.accept(x);
      nodes.row(next++) = x;
    } else if (++misses > patience * count) {
      misses = 0;
      fraction *= 0.97;
    }
  }
  for (int sweep = 0; sweep < smoothing_sweeps; ++sweep) {
    smooth(nodes, on_surface, body, sizing);
  }
  for (int sweep = 0; sweep < shaking_sweeps; ++sweep) {
    shake_slivers(nodes, on_surface, body, random);
  }
  return nodes.bottomRows(static_cast<Eigen::Index>(count));
}

double volume_demand(const Surface& surface, const Scanlines& body, const SizingField& sizing) {
  const Eigen::Vector3d low = surface.vertices.colwise().minCoeff();
  const Eigen::Vector3d high = surface.vertices.colwise().maxCoeff();
  const Eigen::Vector3d step = (high - low) / demand_lines;
  double total = 0;
  std::vector<double> x;
  for (int k = 0; k < demand_lines; ++k) {
    for (int j = 0; j < demand_lines; ++j) {
      const double y = low.y() + (j + 0.5) * step.y();
      const double z = low.z() + (k + 0.5) * step.z();
      body.crossings(y, z, x);
      for (std::size_t pair = 0; pair + 1 < x.size(); pair += 2) {
        const int pieces = std::max(1, static_cast<int>(std::ceil((x[pair + 1] - x[pair]) / step.x())));
        const double length = (x[pair + 1] - x[pair]) / pieces;
        for (int piece = 0; piece < pieces; ++piece) {
          total += length / std::pow(sizing.factor({x[pair] + (piece + 0.5) * length, y, z}), 3);
        }
      }
    }
  }
  return total * step.y() * step.z();
}

}  // namespace brainshift::discretise
