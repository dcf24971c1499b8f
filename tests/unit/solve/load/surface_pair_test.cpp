// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/craniotomy_load.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::solve::surface_pair_test {

const double radius = 80;

/// The part of a sphere about the origin within r of the z axis, above.
Surface cap(double r, int rounds, const Eigen::Matrix3d& turned) {
  Surface whole = test::sphere(Eigen::Vector3d::Zero(), radius, rounds);
  whole.vertices = (whole.vertices * turned.transpose()).eval();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < whole.triangles.rows(); ++t) {
    bool inside = true;
    for (const auto v : whole.triangles.row(t)) {
      inside = inside && whole.vertices(v, 2) > 0 && whole.vertices.row(v).head<2>().norm() <= r;
    }
    if (inside) {
      kept.push_back(t);
    }
  }
  Surface patch{whole.vertices, whole.triangles(kept, Eigen::all)};
  return patch;
}

/// Down by 8 mm amid the opening, with some sideways drift.
Eigen::RowVector3d shift(const Eigen::RowVector3d& x) {
  const double bell = std::pow(std::max(0.0, 1 - x.head<2>().squaredNorm() / (30 * 30)), 2);
  return {0.6 * bell, 0, -8 * bell};
}

Surface shifted(Surface surface) {
  for (auto vertex : surface.vertices.rowwise()) {
    vertex += shift(vertex);
  }
  return surface;
}

TEST(SurfacesBeforeAndAfter, GiveTheMovementAlongTheNormalsOfADifferentlyMeshedSunkenCap) {
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Surface before = cap(28, 5, Eigen::Matrix3d::Identity());
  const Surface after = shifted(cap(40, 6, turned));
  const CraniotomyLoad load = load_from_surfaces(before, after);
  ASSERT_GT(load.positions.rows(), 100);
  double sum = 0, along_normal = 0;
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    const Eigen::RowVector3d error = load.displacement.row(p) - shift(load.positions.row(p));
    sum += error.norm();
    along_normal = std::max(along_normal, std::abs(error.dot(load.positions.row(p)) / radius));
  }
  // The drift sideways is not to be seen, and smoothing rounds the steepest places.
  EXPECT_LT(along_normal, 0.6);
  EXPECT_LT(sum / static_cast<double>(load.positions.rows()), 0.65);
}

TEST(SurfacesBeforeAndAfter, ThatAreTheSameGiveNoDisplacement) {
  const Surface patch = cap(30, 4, Eigen::Matrix3d::Identity());
  EXPECT_LT(load_from_surfaces(patch, patch).displacement.rowwise().norm().maxCoeff(), 1e-6);
}

/// A surface that is one mesh moved lies vertex on vertex on the other, where several triangles are equally near.
TEST(SurfacesBeforeAndAfter, OfOneMeshDoNotHangOnTheLastDigits) {
  Surface before = cap(28, 4, Eigen::Matrix3d::Identity()), after = shifted(before);
  const Points plain = load_from_surfaces(before, after).displacement;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1e-9, 1e-9);
  for (Surface* surface : {&before, &after}) {
    surface->vertices = surface->vertices.unaryExpr([&](double x) { return x + noise(random); }).eval();
  }
  EXPECT_LT((load_from_surfaces(before, after).displacement - plain).rowwise().norm().maxCoeff(), 1e-6);
}

TEST(SurfacesBeforeAndAfter, WhereAfterIsMissingTakeTheNeighboursMovement) {
  const Surface before = cap(30, 5, Eigen::Matrix3d::Identity());
  Surface after = cap(20, 5, Eigen::Matrix3d::Identity());
  after.vertices.col(2).array() -= 5;
  const CraniotomyLoad load = load_from_surfaces(before, after);
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    EXPECT_NEAR(load.displacement(p, 2), -5, 0.7);
  }
}

TEST(SurfacesBeforeAndAfter, GiveTheSameWithAnyNumberOfThreads) {
  const Surface before = cap(25, 4, Eigen::Matrix3d::Identity());
  const Surface after = shifted(cap(35, 5, Eigen::Matrix3d::Identity()));
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Points one = load_from_surfaces(before, after).displacement;
  omp_set_num_threads(3);
  const Points three = load_from_surfaces(before, after).displacement;
  omp_set_num_threads(threads);
  EXPECT_EQ(one, three);
}

TEST(SurfacesBeforeAndAfter, AreRefusedWhenEmptyBrokenOrFarApart) {
  const Surface patch = cap(30, 3, Eigen::Matrix3d::Identity());
  Surface flipped = patch;
  flipped.vertices.col(2) *= -1;
  EXPECT_THROW(load_from_surfaces(patch, flipped), std::invalid_argument);
  EXPECT_THROW(load_from_surfaces(patch, Surface{}), std::invalid_argument);
  EXPECT_THROW(load_from_surfaces(Surface{}, patch), std::invalid_argument);
  Surface broken = patch;
  broken.vertices(patch.triangles(0, 0), 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(load_from_surfaces(broken, patch), std::invalid_argument);
  EXPECT_THROW(load_from_surfaces(patch, broken), std::invalid_argument);
  const Surface small = cap(15, 3, Eigen::Matrix3d::Identity());
  Surface beside = small;
  beside.vertices.rowwise() += Eigen::RowVector3d(28, 0, 0);
  EXPECT_NE(test::refusal([&] { load_from_surfaces(small, beside); }).find(" % of the surface before"),
            std::string::npos);
  Surface flat = patch;
  flat.vertices.setZero();
  EXPECT_THROW(load_from_surfaces(patch, flat), std::invalid_argument);
}

}  // namespace brainshift::solve::surface_pair_test
