// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <string>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/mask.hpp"
#include "segmentation/surface/surface_measures.hpp"

namespace brainshift::test {

inline Eigen::Matrix3d oblique() {
  return (Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

inline Eigen::Matrix3d oblique_left_handed() {
  Eigen::Matrix3d direction = oblique();
  direction.col(2) *= -1.0;
  return direction;
}

/// A grid with the world's point `centre` in its middle.
inline ImageGeometry grid_around(const Eigen::Vector3d& centre, int size, const Eigen::Vector3d& spacing,
                                 const Eigen::Matrix3d& direction) {
  ImageGeometry geometry;
  geometry.size = Eigen::Array3i::Constant(size);
  geometry.spacing = spacing;
  geometry.direction = direction;
  geometry.origin = centre - direction * spacing * (0.5 * (size - 1));
  return geometry;
}

/// Calls set(voxel, world) for every voxel; what it returns becomes the voxel's value.
template <class T, class Set>
Image<T> image_by(const ImageGeometry& geometry, const Set& set) {
  Image<T> image{geometry, std::vector<T>(geometry.voxel_count())};
  for (int k = 0; k < geometry.size.z(); ++k) {
    for (int j = 0; j < geometry.size.y(); ++j) {
      for (int i = 0; i < geometry.size.x(); ++i) {
        image.at(i, j, k) = set(geometry.to_world(Eigen::Vector3d(i, j, k)));
      }
    }
  }
  return image;
}

inline LabelMap ball(const ImageGeometry& geometry, const Eigen::Vector3d& centre, double radius) {
  return image_by<std::uint16_t>(geometry, [&](const Eigen::Vector3d& world) {
    return static_cast<std::uint16_t>((world - centre).norm() <= radius ? 1 : 0);
  });
}

/// Oblique, smooth, with detail along all axes.
inline ScalarImage wavy_image() {
  const auto geometry = grid_around({40.0, -70.0, 15.0}, 24, {0.9, 1.1, 2.5}, oblique_left_handed());
  return image_by<float>(geometry, [](const Eigen::Vector3d& x) {
    return static_cast<float>(100.0 + 50.0 * std::sin(0.3 * x.x()) * std::cos(0.2 * x.y()) + x.z());
  });
}

/// Oblique, with voxels of 1 × 2 × 3 mm.
inline Mask empty_mask(int size) {
  const auto geometry = grid_around(Eigen::Vector3d::Zero(), size, {1.0, 2.0, 3.0}, oblique_left_handed());
  return {geometry, std::vector<std::uint8_t>(geometry.voxel_count())};
}

inline double ball_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

inline Surface tetrahedron() {
  Surface surface;
  surface.vertices.resize(4, 3);
  surface.vertices << 0, 0, 0, 30, 0, 0, 0, 30, 0, 0, 0, 30;
  surface.triangles.resize(4, 3);
  surface.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  return surface;
}

/// Without the triangles that reach into the uppermost share of its height, and so open.
inline Surface without_top(Surface surface, double share) {
  const double high = surface.vertices.col(2).maxCoeff(), low = surface.vertices.col(2).minCoeff();
  Eigen::Index left = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Eigen::RowVector3i triangle = surface.triangles.row(t);
    if (surface.vertices.col(2)(triangle).maxCoeff() < high - share * (high - low)) {
      surface.triangles.row(left++) = triangle;
    }
  }
  surface.triangles.conservativeResize(left, 3);
  return surface;
}

inline void expect_sound(const segmentation::SurfaceMeasures& measures) {
  EXPECT_TRUE(measures.closed);
  EXPECT_TRUE(measures.outward);
  EXPECT_FALSE(measures.self_intersecting);
}

/// Whether the call throws E with all of these words in its sentence.
template <class E, class Call>
::testing::AssertionResult throws_saying(const Call& call, const std::vector<std::string>& words) {
  try {
    call();
  } catch (const E& fault) {
    const std::string sentence = fault.what();
    for (const std::string& word : words) {
      if (sentence.find(word) == std::string::npos) {
        return ::testing::AssertionFailure() << "\"" << sentence << "\" lacks \"" << word << "\"";
      }
    }
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "nothing was thrown";
}

}  // namespace brainshift::test
