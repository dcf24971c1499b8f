// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/craniotomy_load.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::solve::opening_test {

using test::refusal;

const Eigen::RowVector3d centre(-60, 35, 210);
const double radius = 80;

/// Nodes on a sphere, and one within it.
NodeCloud head() {
  const Surface surface = test::sphere(centre, radius, 4);
  const Eigen::Index n = surface.vertices.rows();
  NodeCloud cloud;
  cloud.positions.resize(n + 1, 3);
  cloud.positions << surface.vertices, centre;
  cloud.spacing.assign(static_cast<std::size_t>(n) + 1, 6.0);
  cloud.on_surface.assign(static_cast<std::size_t>(n) + 1, 1);
  cloud.on_surface.back() = 0;
  return cloud;
}

/// Points of the sphere at random within an opening angle about an axis.
Points measured_places(int count, const Eigen::Vector3d& axis, double angle, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Points places(count, 3);
  for (int p = 0; p < count;) {
    const Eigen::Vector3d direction = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    if (std::acos(direction.dot(axis)) <= angle) {
      places.row(p++) = centre + radius * direction.transpose();
    }
  }
  return places;
}

/// A smooth field of the size and extent of a brain shift.
Eigen::RowVector3d field(const Eigen::RowVector3d& place) {
  const Eigen::RowVector3d x = (place - centre) / radius;
  return {3 * x[0] * x[1], 2 * std::sin(2 * x[2]),
          -8 * std::exp(-6 * (x - Eigen::RowVector3d(0, 0.6, 0.8)).squaredNorm())};
}

CraniotomyLoad measured(int count, double angle, unsigned seed = 1) {
  CraniotomyLoad load;
  load.positions = measured_places(count, Eigen::Vector3d(0, 0.6, 0.8), angle, seed);
  load.displacement.resize(count, 3);
  for (int p = 0; p < count; ++p) {
    load.displacement.row(p) = field(load.positions.row(p));
  }
  return load;
}

bool is_loaded(const Points& prescribed, Eigen::Index node) {
  return !std::isnan(prescribed(node, 0));
}

TEST(Opening, LoadsTheNodesUnderItAndNoneUnderTheBoneOrOnTheFarSide) {
  const NodeCloud cloud = head();
  const Eigen::RowVector3d axis(0, 0.6, 0.8);
  const double angle = 0.35;
  const Points prescribed = prescribed_on_surface_nodes(cloud, measured(400, angle));
  ASSERT_EQ(prescribed.rows(), cloud.positions.rows());
  int loaded = 0, far_side = 0;
  for (Eigen::Index n = 0; n + 1 < prescribed.rows(); ++n) {
    const Eigen::RowVector3d direction = (cloud.positions.row(n) - centre) / radius;
    const double off = std::acos(std::clamp(direction.dot(axis), -1.0, 1.0));
    far_side += M_PI - off < angle;
    loaded += is_loaded(prescribed, n);
    if (off < angle - 0.06) {
      EXPECT_TRUE(is_loaded(prescribed, n)) << off;
    }
    if (off > angle + 0.04) {
      EXPECT_FALSE(is_loaded(prescribed, n)) << off;
    }
  }
  EXPECT_GT(loaded, 50);
  EXPECT_GT(far_side, 50) << "the test must offer nodes on the far side";
  EXPECT_FALSE(is_loaded(prescribed, prescribed.rows() - 1)) << "a node within the brain is no surface node";
}

/// Rows of one load below those of another.
CraniotomyLoad both(const CraniotomyLoad& one, const CraniotomyLoad& other) {
  CraniotomyLoad load{Points(one.positions.rows() + other.positions.rows(), 3), {}, {}};
  load.displacement = load.positions;
  load.positions << one.positions, other.positions;
  load.displacement << one.displacement, other.displacement;
  return load;
}

TEST(Opening, PrescribesNothingBetweenTwoThatLieApart) {
  const NodeCloud cloud = head();
  const CraniotomyLoad one = measured(60, 0.35);
  for (const int count : {1, 12}) {
    CraniotomyLoad other;
    other.positions = measured_places(count, Eigen::Vector3d(1, 0, 0), 0.2, 3);
    other.displacement = Points::Constant(count, 3, 0.5);
    const Points apart = prescribed_on_surface_nodes(cloud, one), second = prescribed_on_surface_nodes(cloud, other);
    const Points together = prescribed_on_surface_nodes(cloud, both(one, other));
    int of_second = 0;
    for (Eigen::Index n = 0; n < together.rows(); ++n) {
      const Points& alone = is_loaded(second, n) ? second : apart;
      EXPECT_EQ(is_loaded(together, n), is_loaded(alone, n)) << n;
      if (is_loaded(together, n)) {
        EXPECT_EQ(together.row(n), alone.row(n)) << n;
      }
      of_second += is_loaded(second, n);
    }
    EXPECT_GT(of_second, 0);
  }
}

/// The gap to a point in the middle of a wide opening is no bone.
TEST(Opening, IsOneWhereItsRimIsMeasuredAllAroundAPoint) {
  const NodeCloud cloud = head();
  constexpr int rim = 60;
  CraniotomyLoad load{.positions = Points(rim + 1, 3), .displacement = Points(rim + 1, 3), .sigma = {}};
  load.displacement.rowwise() = Eigen::RowVector3d(0, 0, -1);
  load.displacement(rim, 2) = -8;
  const auto place = [](double angle, double around) -> Eigen::RowVector3d {
    return centre + radius * Eigen::RowVector3d(std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around),
                                                std::cos(angle));
  };
  for (int p = 0; p < rim; ++p) {
    load.positions.row(p) = place(0.45, 2 * std::numbers::pi * p / rim);
  }
  load.positions.row(rim) = place(0, 0);
  const Points sunken = prescribed_on_surface_nodes(cloud, load);
  int half_way = 0;
  for (Eigen::Index n = 0; n < sunken.rows(); ++n) {
    const double away = (cloud.positions.row(n) - place(0, 0)).norm();
    if (away > 14 && away < 20) {  // of 35 mm
      EXPECT_LT(sunken(n, 2), -3) << away;
      EXPECT_GT(sunken(n, 2), -7) << away;
      ++half_way;
    }
  }
  EXPECT_GT(half_way, 3);
}

/// Lines of points that curve with the cortex, 97 mm long and 42 mm apart, are two.
TEST(Opening, OfTwoLinesSideBySideAreTwo) {
  const NodeCloud cloud = head();
  CraniotomyLoad load{.positions = Points(42, 3), .displacement = Points::Constant(42, 3, -1.0), .sigma = {}};
  for (int p = 0; p < 42; ++p) {
    const double along = 0.06 * (p % 21 - 10), across = p < 21 ? 0.26 : -0.26;
    load.positions.row(p) = centre + radius * Eigen::RowVector3d(std::sin(across), std::cos(across) * std::sin(along),
                                                                 std::cos(across) * std::cos(along));
  }
  const Points prescribed = prescribed_on_surface_nodes(cloud, load);
  for (Eigen::Index n = 0; n < prescribed.rows(); ++n) {
    EXPECT_FALSE(is_loaded(prescribed, n) && std::abs(cloud.positions(n, 0) - centre[0]) < 10) << n;
  }
}

TEST(Opening, RefusesPointsAllAroundButTakesAWideCap) {
  const NodeCloud cloud = head();
  EXPECT_NO_THROW(prescribed_on_surface_nodes(cloud, measured(1500, 1.0)));
  const std::string said = refusal([&] { prescribed_on_surface_nodes(cloud, measured(3000, 3.1)); });
  EXPECT_NE(said.find("all around it"), std::string::npos) << said;
}

TEST(Opening, PrescribesAllThreeComponentsOfANodeOrNone) {
  const Points prescribed = prescribed_on_surface_nodes(head(), measured(60, 0.35));
  for (const auto& row : prescribed.rowwise()) {
    EXPECT_TRUE(row.allFinite() || row.array().isNaN().all());
  }
}

TEST(Opening, ExtendsASmoothFieldToATenthOfAMillimetre) {
  const NodeCloud cloud = head();
  const Points prescribed = prescribed_on_surface_nodes(cloud, measured(300, 0.4));
  double sum = 0;
  int loaded = 0;
  for (Eigen::Index n = 0; n < prescribed.rows(); ++n) {
    if (is_loaded(prescribed, n)) {
      const double error = (prescribed.row(n) - field(cloud.positions.row(n))).norm();
      EXPECT_LT(error, 0.25) << "at the rim the spline extrapolates";
      sum += error;
      ++loaded;
    }
  }
  ASSERT_GT(loaded, 50);
  EXPECT_LT(sum / loaded, 0.03);
}

TEST(Opening, TakesTheMeasuredDisplacementWhereItWasMeasured) {
  const NodeCloud cloud = head();
  CraniotomyLoad load = measured(100, 0.4);
  std::vector<Eigen::Index> at;
  for (Eigen::Index n = 0; n < cloud.positions.rows() && at.size() < 40; ++n) {
    if ((cloud.positions.row(n) - centre).dot(Eigen::RowVector3d(0, 0.6, 0.8)) > radius * std::cos(0.38)) {
      load.positions.row(static_cast<Eigen::Index>(at.size())) = cloud.positions.row(n);
      load.displacement.row(static_cast<Eigen::Index>(at.size())) = field(cloud.positions.row(n));
      at.push_back(n);
    }
  }
  ASSERT_EQ(at.size(), 40);
  const Points prescribed = prescribed_on_surface_nodes(cloud, load);
  for (const Eigen::Index n : at) {
    EXPECT_LT((prescribed.row(n) - field(cloud.positions.row(n))).norm(), 1e-6);
  }
}

TEST(Opening, DoesNotOvershootNoisyMeasurements) {
  CraniotomyLoad load = measured(80, 0.4);
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0, 1.0);
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    load.displacement.row(p) += Eigen::RowVector3d(noise(random), noise(random), noise(random));
  }
  load.positions.row(1) = load.positions.row(0);
  load.positions.row(3) = load.positions.row(2) + Eigen::RowVector3d::Constant(1e-4);
  const Points prescribed = prescribed_on_surface_nodes(head(), load);
  for (int axis = 0; axis < 3; ++axis) {
    const double least = load.displacement.col(axis).minCoeff(), most = load.displacement.col(axis).maxCoeff();
    const double room = 0.1 * (most - least) + 1e-9;
    for (Eigen::Index n = 0; n < prescribed.rows(); ++n) {
      if (is_loaded(prescribed, n)) {
        EXPECT_GE(prescribed(n, axis), least - room);
        EXPECT_LE(prescribed(n, axis), most + room);
      }
    }
  }
}

TEST(Opening, OfOnePointOrOfPointsOnALineLoadsTheNodesBesideThem) {
  const NodeCloud cloud = head();
  CraniotomyLoad load;
  load.positions = cloud.positions.topRows(1);
  load.displacement = Points::Constant(1, 3, -2.0);
  const Points one = prescribed_on_surface_nodes(cloud, load, {.margin = 8});
  EXPECT_EQ(one.row(0), Eigen::RowVector3d(-2, -2, -2));
  EXPECT_LT((one.col(0).array() == -2.0).count(), 20);

  load.positions.resize(9, 3);
  load.displacement = Points::Constant(9, 3, 1.5);
  for (const double step : {0.05, 0.15}) {  // the second is a line that curves with the surface, by 14 mm
    for (int p = 0; p < 9; ++p) {
      const double angle = step * (p - 4);
      load.positions.row(p) = centre + radius * Eigen::RowVector3d(std::sin(angle), 0, std::cos(angle));
    }
    const Points line = prescribed_on_surface_nodes(cloud, load, {.margin = 5});
    int loaded = 0;
    for (Eigen::Index n = 0; n < line.rows(); ++n) {
      if (is_loaded(line, n)) {
        ++loaded;
        EXPECT_NEAR(line(n, 2), 1.5, 1e-9);
        EXPECT_LT(std::abs(cloud.positions(n, 1) - centre[1]), 5.1 + cloud.spacing.front() / 4) << "on the rim";
        EXPECT_GT(cloud.positions(n, 2), centre[2]);
      }
    }
    EXPECT_GT(loaded, 3) << step;
  }
}

TEST(Opening, RefusesAPointFarFromTheSurfaceWithItsDistanceAndGuessesAFlippedFrame) {
  const NodeCloud cloud = head();
  CraniotomyLoad far = measured(20, 0.3);
  far.positions.row(6) += Eigen::RowVector3d(0, 18, 24);
  const std::string alone = refusal([&] { prescribed_on_surface_nodes(cloud, far); });
  EXPECT_NE(alone.find("point 7 of 20"), std::string::npos) << alone;
  EXPECT_NE(alone.find("is 30."), std::string::npos) << alone;
  EXPECT_EQ(alone.find("RAS"), std::string::npos) << alone;

  CraniotomyLoad flipped = measured(20, 0.3);
  flipped.positions.leftCols(2) *= -1;
  const std::string hint = refusal([&] { prescribed_on_surface_nodes(cloud, flipped); });
  EXPECT_NE(hint.find("RAS"), std::string::npos) << hint;
}

TEST(Opening, RefusesPlacesForDisplacements) {
  CraniotomyLoad load = measured(20, 0.3);
  load.displacement += load.positions;
  EXPECT_NE(refusal([&] { prescribed_on_surface_nodes(head(), load); }).find("where the points went"),
            std::string::npos);
}

TEST(Opening, RefusesToLoadNoNode) {
  NodeCloud cloud = head();
  cloud.spacing.assign(cloud.size(), 1e-3);  // no node counts as lying on the rim
  CraniotomyLoad between;
  between.positions = 0.5 * (cloud.positions.row(12) + cloud.positions.row(0));
  between.displacement = Points::Constant(1, 3, 1.0);
  const std::string none =
      refusal([&] { prescribed_on_surface_nodes(cloud, between, {.margin = 0.0, .farthest = 200}); });
  EXPECT_NE(none.find("no surface node"), std::string::npos) << none;
  cloud.on_surface.assign(cloud.size(), 0);
  EXPECT_NE(refusal([&] { prescribed_on_surface_nodes(cloud, measured(20, 0.3)); }).find("on_surface"),
            std::string::npos);
}

TEST(Opening, RefusesAPointThatMovesByMoreThanHalfOfTheBody) {
  CraniotomyLoad load = measured(20, 0.3);
  load.displacement.row(6) << 0, 79, 0;
  EXPECT_EQ(refusal([&] { prescribed_on_surface_nodes(head(), load); }), "");
  for (const double moved : {81.0, 1e30, 1e300}) {
    load.displacement.row(6) << 0, moved, 0;
    const std::string message = refusal([&] { prescribed_on_surface_nodes(head(), load); });
    EXPECT_NE(message.find("measured point 7 of 20 moves by"), std::string::npos) << message;
  }
}

TEST(Opening, OfManyEqualPointsIsThatOfOne) {
  CraniotomyLoad one = measured(1, 0.01), many;
  many.positions = one.positions.replicate(50'000, 1);
  many.displacement = one.displacement.replicate(50'000, 1);
  const NodeCloud cloud = head();
  const Points expected = prescribed_on_surface_nodes(cloud, one);
  const Points found = prescribed_on_surface_nodes(cloud, many);
  for (Eigen::Index n = 0; n < expected.rows(); ++n) {
    ASSERT_EQ(is_loaded(found, n), is_loaded(expected, n)) << n;
    if (is_loaded(found, n)) {
      EXPECT_LE((found.row(n) - expected.row(n)).norm(), 1e-9);
    }
  }
}

TEST(Opening, TakesHundredsOfThousandsOfPointsInSeconds) {
  const auto begin = std::chrono::steady_clock::now();
  prescribed_on_surface_nodes(head(), measured(200'000, 0.3));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(seconds.count(), 30) << "a search of all points for each of them takes minutes";
}

TEST(Opening, RefusesALoadThatIsEmptyOrNotFinite) {
  const NodeCloud cloud = head();
  EXPECT_THROW(prescribed_on_surface_nodes(cloud, {}), std::invalid_argument);
  CraniotomyLoad load = measured(5, 0.3);
  load.displacement(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal([&] { prescribed_on_surface_nodes(cloud, load); }).find("point 3"), std::string::npos);
}

}  // namespace brainshift::solve::opening_test
