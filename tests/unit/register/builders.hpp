// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A small head to register: a ball of a brain in a small image.

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "register/registration.hpp"
#include "segmentation/files/point_values.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration::builders {

using DisplacementOf = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

inline const Eigen::Vector3d centre(3, -5, 8);
inline constexpr double radius = 24;

/// A ball of meridians and parallels, outward.
inline Surface ball(const Eigen::Vector3d& middle, double r, int parallels = 16) {
  const int around = 2 * parallels;
  const auto ring = [&](int i, int j) { return 2 + (i - 1) * around + j % around; };
  Surface surface;
  surface.vertices.resize(2 + (parallels - 1) * around, 3);
  surface.vertices.row(0) = (middle + r * Eigen::Vector3d::UnitZ()).transpose();
  surface.vertices.row(1) = (middle - r * Eigen::Vector3d::UnitZ()).transpose();
  std::vector<Eigen::RowVector3i> triangles;
  for (int j = 0; j < around; ++j) {
    for (int i = 1; i < parallels; ++i) {
      const double tilt = std::numbers::pi * i / parallels, turn = 2 * std::numbers::pi * j / around;
      surface.vertices.row(ring(i, j)) = (middle + r * Eigen::Vector3d(std::sin(tilt) * std::cos(turn),
                                                                       std::sin(tilt) * std::sin(turn), std::cos(tilt)))
                                             .transpose();
      if (i + 1 < parallels) {
        triangles.emplace_back(ring(i, j), ring(i + 1, j), ring(i + 1, j + 1));
        triangles.emplace_back(ring(i, j), ring(i + 1, j + 1), ring(i, j + 1));
      }
    }
    triangles.emplace_back(0, ring(1, j), ring(1, j + 1));
    triangles.emplace_back(1, ring(parallels - 1, j + 1), ring(parallels - 1, j));
  }
  surface.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    surface.triangles.row(static_cast<Eigen::Index>(t)) = triangles[t];
  }
  return surface;
}

inline Solution solution_at(const std::vector<Eigen::Vector3d>& nodes, double spacing,
                            const DisplacementOf& displacement) {
  Solution result;
  result.positions.resize(static_cast<Eigen::Index>(nodes.size()), 3);
  result.displacement.resize(result.positions.rows(), 3);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    result.positions.row(static_cast<Eigen::Index>(n)) = nodes[n].transpose();
    result.displacement.row(static_cast<Eigen::Index>(n)) = displacement(nodes[n]).transpose();
  }
  result.reaction_force = Points::Zero(result.positions.rows(), 3);
  result.spacing.assign(nodes.size(), spacing);
  return result;
}

/// Nodes in the brain, irregular, and their displacement.
inline Solution solution(const DisplacementOf& displacement) {
  constexpr double spacing = 5;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.2 * spacing, 0.2 * spacing);
  std::vector<Eigen::Vector3d> nodes;
  for (double z = -radius; z <= radius; z += spacing) {
    for (double y = -radius; y <= radius; y += spacing) {
      for (double x = -radius; x <= radius; x += spacing) {
        const Eigen::Vector3d node = Eigen::Vector3d(x + jitter(random), y + jitter(random), z + jitter(random));
        if (node.norm() < radius - 0.4 * spacing) {
          nodes.push_back(centre + node);
        }
      }
    }
  }
  constexpr int on_surface = 290;  // a spiral with one node in 25 mm²
  for (int n = 0; n < on_surface; ++n) {
    const double z = 1 - (2 * n + 1.0) / on_surface, turn = n * std::numbers::pi * (3 - std::sqrt(5.0));
    const double flat = std::sqrt(1 - z * z);
    nodes.push_back(centre + radius * Eigen::Vector3d(flat * std::cos(turn), flat * std::sin(turn), z));
  }
  return solution_at(nodes, spacing, displacement);
}

/// What is left of a solution at the nodes for which `kept` is true of their position.
template <class Kept>
Solution at_nodes(Solution all, const Kept& kept) {
  Eigen::Index left = 0;
  for (Eigen::Index a = 0; a < all.positions.rows(); ++a) {
    if (kept(Eigen::Vector3d(all.positions.row(a)))) {
      for (Points* const rows : {&all.positions, &all.displacement, &all.reaction_force}) {
        rows->row(left) = rows->row(a).eval();
      }
      all.spacing[static_cast<std::size_t>(left++)] = all.spacing[static_cast<std::size_t>(a)];
    }
  }
  for (Points* const rows : {&all.positions, &all.displacement, &all.reaction_force}) {
    rows->conservativeResize(left, 3);
  }
  all.spacing.resize(static_cast<std::size_t>(left));
  return all;
}

/// A grid with the brain in its middle.
inline ImageGeometry grid(const Eigen::Array3i& size = {56, 50, 48}, const Eigen::Vector3d& spacing = {1.6, 1.8, 2.0},
                          const Eigen::Matrix3d& direction = Eigen::Matrix3d::Identity()) {
  ImageGeometry g;
  g.size = size;
  g.spacing = spacing;
  g.direction = direction;
  g.origin = centre - direction * spacing.cwiseProduct(((size - 1).cast<double>() / 2).matrix());
  return g;
}

inline Eigen::Matrix3d oblique() {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
  return Eigen::AngleAxisd(0.6, axis).toRotationMatrix();
}

/// Calls use(world position, offset) for every voxel.
template <class Use>
void for_each_voxel(const ImageGeometry& g, const Use& use) {
  for (int k = 0; k < g.size.z(); ++k) {
    for (int j = 0; j < g.size.y(); ++j) {
      for (int i = 0; i < g.size.x(); ++i) {
        use(g.to_world(Eigen::Vector3d(i, j, k)), g.offset(i, j, k));
      }
    }
  }
}

inline ScalarImage image(const ImageGeometry& g, const std::function<double(const Eigen::Vector3d&)>& value) {
  ScalarImage result{g, std::vector<float>(g.voxel_count())};
  for_each_voxel(g, [&](const Eigen::Vector3d& x, std::size_t v) { result.voxels[v] = static_cast<float>(value(x)); });
  return result;
}

inline LabelMap label_map(const ImageGeometry& g, const std::function<int(const Eigen::Vector3d&)>& value) {
  LabelMap result{g, std::vector<std::uint16_t>(g.voxel_count())};
  for_each_voxel(
      g, [&](const Eigen::Vector3d& x, std::size_t v) { result.voxels[v] = static_cast<std::uint16_t>(value(x)); });
  return result;
}

inline VectorImage field(const ImageGeometry& g, const DisplacementOf& displacement) {
  VectorImage result{g, std::vector<std::array<float, 3>>(g.voxel_count())};
  for_each_voxel(g, [&](const Eigen::Vector3d& x, std::size_t v) {
    const Eigen::Vector3f u = displacement(x).cast<float>();
    result.voxels[v] = {u.x(), u.y(), u.z()};
  });
  return result;
}

inline Eigen::Vector3d at(const VectorImage& field, std::size_t v) {
  return {field.voxels[v][0], field.voxels[v][1], field.voxels[v][2]};
}

/// A brain that sinks by up to 8 mm under an opening at its top.
inline Eigen::Vector3d sinking(const Eigen::Vector3d& x) {
  const Eigen::Vector3d opening = centre + Eigen::Vector3d(5, 3, radius);
  return 8 * std::exp(-(x - opening).squaredNorm() / (2 * 18 * 18)) * Eigen::Vector3d(-0.2, 0.1, -0.97);
}

/// A smooth picture with detail in all directions.
inline double texture(const Eigen::Vector3d& x) {
  return 100 + 40 * std::sin(0.4 * x.x()) * std::cos(0.3 * x.y()) + 30 * std::sin(0.35 * x.z() + 0.1 * x.x());
}

/// What might go along with points: their height as estimated_error, twice that as uncertainty.
inline std::vector<PointValues> heights(const Points& places) {
  const Eigen::VectorXd z = places.col(2), twice = 2 * z;
  return {{"estimated_error", {z.data(), z.data() + z.size()}},
          {"uncertainty", {twice.data(), twice.data() + twice.size()}}};
}

inline RegisterInput head(const DisplacementOf& displacement, const ImageGeometry& g = grid()) {
  RegisterInput input;
  input.solution = solution(displacement);
  input.brain = ball(centre, radius);
  input.t1 = image(g, texture);
  input.labels = label_map(g, [](const Eigen::Vector3d& x) {
    const double r = (x - centre).norm();
    return r < 10 ? 2 : r < radius ? 1 : 0;
  });
  return input;
}

}  // namespace brainshift::registration::builders
