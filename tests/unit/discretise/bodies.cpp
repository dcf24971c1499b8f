// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/discretise/bodies.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace brainshift::test {
namespace {

/// The unit sphere.
Surface unit_sphere(int splits) {
  std::vector<Eigen::Vector3d> vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<std::int32_t, 3>> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(vertices.size()));
      if (is_new) {
        const Eigen::Vector3d sum = vertices[static_cast<std::size_t>(a)] + vertices[static_cast<std::size_t>(b)];
        vertices.push_back(sum.normalized());
      }
      return place->second;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::int32_t ab = middle(a, b);
      const std::int32_t bc = middle(b, c);
      const std::int32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  Surface surface;
  surface.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  surface.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    surface.vertices.row(static_cast<Eigen::Index>(i)) = vertices[i].transpose();
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    surface.triangles.row(static_cast<Eigen::Index>(i)) << triangles[i][0], triangles[i][1], triangles[i][2];
  }
  return surface;
}

}  // namespace

Surface ball(double radius, const Eigen::Vector3d& centre, int splits) {
  Surface surface = unit_sphere(splits);
  surface.vertices *= radius;
  surface.vertices.rowwise() += centre.transpose();
  return surface;
}

Surface bumpy_brain() {
  Surface surface = unit_sphere(5);
  for (auto vertex : surface.vertices.rowwise()) {
    const double bump = 0.12 * std::sin(7 * vertex[0] + 1) * std::sin(9 * vertex[1]) * std::cos(8 * vertex[2]);
    vertex = (1 + bump) * vertex.cwiseProduct(Eigen::RowVector3d(80, 65, 60)) + Eigen::RowVector3d(10, -300, 77);
  }
  return surface;
}

LabelMap ball_labels(const Eigen::Vector3d& centre, double inner, double outer) {
  LabelMap labels;
  const int size = static_cast<int>(2 * outer) + 9;
  labels.geometry.size = {size, size, size};
  labels.geometry.direction = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  labels.geometry.direction.col(0) *= -1;
  labels.geometry.origin = centre - labels.geometry.direction * Eigen::Vector3d::Constant(0.5 * (size - 1));
  labels.voxels.resize(labels.geometry.voxel_count());
  for (int k = 0; k < size; ++k) {
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) {
        const double distance = (labels.geometry.to_world(Eigen::Vector3d(i, j, k)) - centre).norm();
        labels.at(i, j, k) = static_cast<std::uint16_t>(distance < inner ? 3 : distance < outer ? 1 : 0);
      }
    }
  }
  return labels;
}

discretise::Discretisation with_nodes(const Surface& surface, std::size_t nodes, CellKind kind) {
  discretise::DiscretiseOptions options;
  options.nodes = nodes;
  options.cells = kind;
  return discretise::discretise(surface, nullptr, options);
}

}  // namespace brainshift::test
