// SPDX-License-Identifier: GPL-3.0-or-later

#include "segmentation/geometry/signed_distance.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <vtkCellArray.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::signed_distance_test {

using test::box;
using test::sphere;

/// VTK's own exact distance, negative inside.
class ExactDistance {
 public:
  explicit ExactDistance(const Surface& surface) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const auto& v : surface.vertices.rowwise()) {
      points->InsertNextPoint(v[0], v[1], v[2]);
    }
    vtkNew<vtkCellArray> cells;
    for (const auto& t : surface.triangles.rowwise()) {
      const vtkIdType corners[3] = {t[0], t[1], t[2]};
      cells->InsertNextCell(3, corners);
    }
    vtkNew<vtkPolyData> mesh;
    mesh->SetPoints(points);
    mesh->SetPolys(cells);
    distance_->SetInput(mesh);
  }
  double operator()(const Eigen::Vector3d& p) { return distance_->EvaluateFunction(p.x(), p.y(), p.z()); }

 private:
  vtkNew<vtkImplicitPolyDataDistance> distance_;
};

Eigen::Vector3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

TEST(SignedDistance, OfASphereIsTheDistanceToItsCentreLessTheRadiusFarFromTheOrigin) {
  const Eigen::Vector3d centre(-310, 145, 620);
  const double radius = 40;
  const SignedDistance distance(sphere(centre, radius, 5), {.spacing = 1.0});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(2.0, 64.0);
  for (int n = 0; n < 2000; ++n) {
    const double r = uniform(random);
    const Eigen::Vector3d direction = random_direction(random);
    // The inscribed polyhedron lies up to 0.03 mm inside the sphere, and the trilinear error is h²/8 · 2/r. Far out the
    // nearest triangle may be missed, most of all deep inside a ball, where every one is about as near as any other.
    const double missed = std::abs(r - radius) < 3 ? 0 : (r > 30 ? 0.05 : 0.5);
    const double bound = 0.035 + 0.25 / r + missed;
    EXPECT_NEAR(distance.value(centre + r * direction), r - radius, bound) << r;
    if (r > 25) {
      // The facets' own normals are off by up to 0.02 rad.
      EXPECT_LT(std::acos(std::min(1.0, distance.gradient(centre + r * direction).dot(direction))), 0.06) << r;
    }
  }
}

TEST(SignedDistance, OfABoxHasTheRightSignAtEdgesAndCorners) {
  const Eigen::Vector3d low(10, 20, 30), high(34, 50, 48);
  const SignedDistance distance(box(low, high), {.spacing = 0.7, .margin = 10});
  const auto exact = [&](const Eigen::Vector3d& p) {
    const Eigen::Array3d outside = ((p - 0.5 * (low + high)).cwiseAbs() - 0.5 * (high - low)).array();
    return outside.max(0.0).matrix().norm() + std::min(outside.maxCoeff(), 0.0);
  };
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0), reach(-3.0, 3.0);
  for (int n = 0; n < 20000; ++n) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis) {
      const double side = unit(random) < 0.5 ? low[axis] : high[axis];
      p[axis] = n % 4 == axis ? low[axis] + unit(random) * (high[axis] - low[axis]) : side + reach(random);
    }
    // At a convex corner trilinear interpolation rounds by up to about h/√3.
    EXPECT_NEAR(distance.value(p), exact(p), 0.45) << p.transpose();
    if (std::abs(exact(p)) > 0.45) {
      EXPECT_EQ(distance.value(p) < 0, exact(p) < 0) << p.transpose();
    }
  }
}

TEST(SignedDistance, IsExactAtSamplesNearASurfaceWithSharpFeatures) {
  Surface star = sphere({5, -3, 8}, 20, 2);
  for (Eigen::Index v = 0; v < star.vertices.rows(); v += 3) {
    star.vertices.row(v) *= 1.4;
  }
  const double h = 1.0, margin = 6;
  const SignedDistance distance(star, {.spacing = h, .margin = margin});
  ExactDistance exact(star);
  const Eigen::Vector3d origin = star.vertices.colwise().minCoeff().transpose().array() - margin;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> index(0, 60);
  int near = 0;
  for (int n = 0; n < 20000; ++n) {
    const Eigen::Vector3d p = origin + h * Eigen::Vector3d(index(random), index(random), index(random));
    const double answer = exact(p);
    if (std::abs(answer) < 2.9 * h) {
      ++near;
      EXPECT_NEAR(distance.value(p), answer, 1e-5) << p.transpose();
    }
  }
  EXPECT_GT(near, 1000);
}

TEST(SignedDistance, KnownNearTheSurfaceAloneIsTheSameThereAndItsHorizonBeyond) {
  const Surface ball = sphere({7, -4, 2}, 30, 3);
  SignedDistanceOptions options;
  const SignedDistance all(ball, options);
  options.far = false;
  const SignedDistance near(ball, options);
  EXPECT_EQ(near.horizon(), options.band());
  EXPECT_FALSE(std::isfinite(all.horizon()));
  std::mt19937 random(8);
  std::uniform_real_distribution<double> reach(-20.0, 20.0);
  int within = 0;
  for (int n = 0; n < 5000; ++n) {
    const Eigen::Vector3d p = Eigen::Vector3d(7, -4, 2) + (30 + reach(random)) * random_direction(random);
    const double distance = all.value(p);
    if (std::abs(distance) < options.band() - 2 * options.spacing) {  // all eight samples are within the band
      ++within;
      EXPECT_EQ(near.value(p), distance) << p.transpose();
    } else if (std::abs(distance) > options.band() + 2 * options.spacing) {
      EXPECT_NEAR(near.value(p), std::copysign(near.horizon(), distance), 1e-6) << p.transpose();
      EXPECT_EQ(near.gradient(p).norm(), 0) << p.transpose();
    }
  }
  EXPECT_GT(within, 100);
}

TEST(SignedDistance, FarFromTheSurfaceIsWithinATenthOfTheGridSpacingOfTheExactDistance) {
  Surface blob = sphere({0, 0, 0}, 50, 4);
  for (auto vertex : blob.vertices.rowwise()) {
    vertex *= 1 + 0.15 * std::sin(0.15 * vertex[0]) * std::cos(0.12 * vertex[1] + 0.1 * vertex[2]);
  }
  const double h = 1.5, margin = 25;
  const SignedDistance distance(blob, {.spacing = h, .margin = margin});
  ExactDistance exact(blob);
  const Eigen::Vector3d origin = blob.vertices.colwise().minCoeff().transpose().array() - margin;
  const Eigen::Vector3d wide = blob.vertices.colwise().maxCoeff().transpose().array() + margin - origin.array();
  std::mt19937 random(4);
  for (int n = 0; n < 5000; ++n) {
    Eigen::Vector3d p = origin;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] += h * std::uniform_int_distribution<int>(0, static_cast<int>(wide[axis] / h))(random);
    }
    EXPECT_NEAR(distance.value(p), exact(p), 0.1 * h) << p.transpose();
  }
}

TEST(SignedDistance, OutsideItsGridGrowsWithTheDistanceToTheGrid) {
  const SignedDistance distance(sphere({0, 0, 0}, 10, 3), {.spacing = 1.0, .margin = 5});
  EXPECT_NEAR(distance.value({100, 0, 0}), 90, 0.2);
  EXPECT_NEAR(distance.value({0, 0, -300}), 290, 0.2);
  EXPECT_GT(distance.value({60, 60, 60}), 60);
  EXPECT_NEAR(distance.gradient({100, 0, 0}).x(), 1, 1e-6);
  EXPECT_TRUE(std::isnan(distance.value({std::numeric_limits<double>::quiet_NaN(), 0, 0})));
}

TEST(SignedDistance, HasTheGradientOfItsValuesUpToAndBeyondTheGridsBorder) {
  const SignedDistance distance(box({-10, -6, -8}, {10, 6, 8}), {.spacing = 1.5, .margin = 5});
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-20, 20);
  for (int n = 0; n < 5000; ++n) {
    const Eigen::Vector3d p(uniform(random), uniform(random), uniform(random));
    Eigen::Vector3d difference;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d half = 0.75 * Eigen::Vector3d::Unit(axis);
      difference[axis] = distance.value(p + half) - distance.value(p - half);
    }
    distance.fetch(p);  // wherever it lies
    EXPECT_LT((distance.gradient(p) - difference.normalized()).norm(), 1e-6) << p.transpose();
  }
}

TEST(SignedDistance, DoesNotDependOnTheNumberOfThreads) {
  const Surface surface = sphere({3, 4, 5}, 20, 3);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const SignedDistance one(surface);
  omp_set_num_threads(3);
  const SignedDistance three(surface);
  omp_set_num_threads(threads);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-50, 60);
  for (int n = 0; n < 20000; ++n) {
    const Eigen::Vector3d p(uniform(random), uniform(random), uniform(random));
    ASSERT_EQ(one.value(p), three.value(p));
  }
}

TEST(SignedDistance, RefusesASurfaceThatIsOpenInsideOutOrTooLarge) {
  const Surface good = sphere({0, 0, 0}, 10, 2);
  Surface open = good;
  open.triangles.conservativeResize(open.triangles.rows() - 1, 3);
  EXPECT_THROW(SignedDistance{open}, std::invalid_argument);
  Surface inside_out = good;
  inside_out.triangles.col(0).swap(inside_out.triangles.col(1));
  EXPECT_THROW(SignedDistance{inside_out}, std::invalid_argument);
  Surface one_turned = good;
  std::swap(one_turned.triangles(0, 0), one_turned.triangles(0, 1));
  EXPECT_THROW(SignedDistance{one_turned}, std::invalid_argument);
  Surface in_micrometres = good;
  in_micrometres.vertices *= 1000;
  EXPECT_THROW(SignedDistance{in_micrometres}, std::invalid_argument);
  Surface broken = good;
  broken.vertices(5, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SignedDistance{broken}, std::invalid_argument);
  EXPECT_THROW(SignedDistance{Surface{}}, std::invalid_argument);
  EXPECT_THROW(SignedDistance(good, {.spacing = 0}), std::invalid_argument);
}

}  // namespace brainshift::signed_distance_test
