// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/measures.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "register/field/field_sampler.hpp"
#include "register/field/nearest_node.hpp"
#include "segmentation/image/voxels.hpp"

namespace brainshift::registration {

namespace {

double length(const std::array<float, 3>& u) {
  return Eigen::Vector3d(u[0], u[1], u[2]).norm();
}

/// |u(x) + d(x + u(x))| at the brain's voxels, in their order.
std::vector<float> inverse_errors(const VectorImage& forward, const VectorImage& resampling,
                                  const std::vector<Zone>& zone) {
  const ImageGeometry& g = forward.geometry;
  const FieldSampler back(resampling);
  std::vector<float> by_voxel(g.voxel_count());
  for_each_voxel_in_parallel(g.size, [&](int i, int j, int k) {
    const std::size_t offset = g.offset(i, j, k);
    if (zone[offset] == Zone::brain) {
      const auto& f = forward.voxels[offset];
      const Eigen::Vector3d u(f[0], f[1], f[2]);
      const Eigen::Vector3d y = Eigen::Vector3d(i, j, k) + back.index_from_world() * u;
      by_voxel[offset] = static_cast<float>((u + back.value(y)).norm());
    }
  });
  std::vector<float> errors;
  for (std::size_t v = 0; v < zone.size(); ++v) {
    if (zone[v] == Zone::brain) {
      errors.push_back(by_voxel[v]);
    }
  }
  return errors;
}

void measure_inverse(std::vector<float> errors, RegisterMeasures& measures) {
  measures.brain_voxels = errors.size();
  measures.inverse_mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), errors.begin() + rank, errors.end());
  measures.inverse_999 = errors[static_cast<std::size_t>(rank)];
  measures.inverse_max = *std::max_element(errors.begin() + rank, errors.end());
}

void measure_jacobian(const ScalarImage& jacobian, const std::vector<Zone>& zone, RegisterMeasures& measures) {
  measures.jacobian_min = measures.field_jacobian_min = std::numeric_limits<double>::infinity();
  measures.jacobian_max = -std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < zone.size(); ++v) {
    const double j = jacobian.voxels[v];
    measures.field_jacobian_min = std::min(measures.field_jacobian_min, j);
    measures.folded_voxels += j > 0 ? 0 : 1;
    if (zone[v] == Zone::brain) {
      measures.jacobian_min = std::min(measures.jacobian_min, j);
      measures.jacobian_max = std::max(measures.jacobian_max, j);
    }
  }
}

/// By every second voxel along each axis. Their displacement is made up from afar.
std::size_t voxels_without_nodes(const ImageGeometry& g, const std::vector<Zone>& zone, const Solution& solution) {
  constexpr int every = 2;
  constexpr double far = 1.5;  // spacings; where nodes fill the brain it is 1.13 at most
  const PointTree nodes(solution.positions);
  std::size_t found = 0;
#pragma omp parallel for schedule(dynamic, 1) reduction(+ : found)
  for (int k = 0; k < g.size.z(); k += every) {
    for (int j = 0; j < g.size.y(); j += every) {
      for (int i = 0; i < g.size.x(); i += every) {
        if (zone[g.offset(i, j, k)] == Zone::brain) {
          const Eigen::Vector3d x = g.to_world(Eigen::Vector3d(i, j, k));
          found += spacings_to_node(nodes, solution, x) > far ? 1 : 0;
        }
      }
    }
  }
  return found * every * every * every;
}

double fit_error(const VectorImage& forward, const Solution& solution) {
  const FieldSampler sampler(forward);
  double largest = 0;
  for (Eigen::Index n = 0; n < solution.positions.rows(); ++n) {
    const Eigen::Vector3d index = sampler.to_index(solution.positions.row(n));
    if (sampler.inside(index)) {
      const Eigen::Vector3d expected = solution.displacement.row(n);
      largest = std::max(largest, (sampler.value(index) - expected).norm());
    }
  }
  return largest;
}

}  // namespace

RegisterMeasures measure_fields(const VectorImage& forward, const VectorImage& resampling, const ScalarImage& jacobian,
                                const std::vector<Zone>& zone, const Solution& solution) {
  RegisterMeasures measures;
  measure_inverse(inverse_errors(forward, resampling, zone), measures);
  measure_jacobian(jacobian, zone, measures);
  for (const std::array<float, 3>& u : forward.voxels) {
    const double moved = length(u);
    measures.moved_voxels += moved > 0 ? 1 : 0;
    measures.largest_displacement = std::max(measures.largest_displacement, moved);
  }
  measures.fit_error = fit_error(forward, solution);
  measures.without_nodes = voxels_without_nodes(forward.geometry, zone, solution);
  return measures;
}

}  // namespace brainshift::registration
