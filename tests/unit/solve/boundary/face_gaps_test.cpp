// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/face_gaps.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

namespace brainshift::solve::face_gaps_test {

constexpr double spacing = 1;

/// The two faces of a cut, a thousandth of the spacing off it.
struct Faces {
  std::vector<FacePlace> places;
  Points nodes;

  void add(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
    places.push_back({place, normal, spacing});
    nodes.conservativeResize(2 * static_cast<Eigen::Index>(places.size()), 3);
    nodes.bottomRows<2>() << (place + 1e-3 * normal).transpose(), (place - 1e-3 * normal).transpose();
  }
  FaceGaps gaps() const { return {places, nodes}; }
  /// The nodes of the face above (side 0) or below (1) elsewhere.
  Points moved(const std::function<Eigen::RowVector3d(const Eigen::RowVector3d& x, Eigen::Index side)>& to) const {
    Points result = nodes;
    for (Eigen::Index f = 0; f < nodes.rows(); ++f) {
      result.row(f) = to(nodes.row(f), f % 2);
    }
    return result;
  }
};

Faces line() {
  Faces faces;
  for (int i = 0; i < 12; ++i) {
    faces.add({i * spacing, 0, 0}, Eigen::Vector3d::UnitY());
  }
  return faces;
}

Faces sheet() {
  Faces faces;
  for (int i = 0; i < 36; ++i) {
    faces.add({i % 6 * spacing, 0, i / 6 * spacing}, Eigen::Vector3d::UnitY());
  }
  return faces;
}

TEST(FaceGaps, AreNoneUndeformed) {
  for (const Faces& faces : {line(), sheet()}) {
    EXPECT_LE(faces.gaps().gaps().cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(FaceGaps, AreHowFarTheFacesOpenOrOverlap) {
  for (const Faces& faces : {line(), sheet()}) {
    FaceGaps gaps = faces.gaps();
    for (const double apart : {0.4, -0.3}) {
      gaps.move(faces.moved([&](const auto& x, Eigen::Index side) -> Eigen::RowVector3d {
        return x + Eigen::RowVector3d(0, side == 0 ? apart : 0, 0);
      }));
      EXPECT_LE((gaps.gaps().array() - apart).abs().maxCoeff(), 1e-9) << "seen from either face";
    }
  }
}

TEST(FaceGaps, DoNotChangeWhereTheBodyTurnsAsAWhole) {
  const Eigen::Matrix3d in_plane = Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (const Faces& faces : {line(), sheet()}) {
    FaceGaps gaps = faces.gaps();
    gaps.move(faces.moved([&](const auto& x, Eigen::Index) -> Eigen::RowVector3d {
      return x * in_plane.transpose() + Eigen::RowVector3d(5, 7, 0);
    }));
    EXPECT_LE(gaps.gaps().cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(FaceGaps, StayClosedWhereFacesSlide) {
  const Faces faces = line();
  FaceGaps gaps = faces.gaps();
  gaps.move(faces.moved([](const auto& x, Eigen::Index side) -> Eigen::RowVector3d {
    return x + Eigen::RowVector3d(side == 0 ? 3.4 : 0, 0, 0);
  }));
  for (Eigen::Index f = 0; f < gaps.gaps().size(); ++f) {
    const double x = faces.nodes(f, 0) + (f % 2 == 0 ? 3.4 : 0);
    if (x > 3.4 && x < 11) {
      EXPECT_NEAR(gaps.gaps()[f], 0, 1e-9);
    }
  }
  EXPECT_TRUE(std::isinf(gaps.gaps()[2 * 11])) << "slid out over the end: nothing is opposite";
}

/// A face that slides along an arc: normals at one of the two nodes alone would err by s²/(2R) = 6e-3 mm.
TEST(FaceGaps, StayClosedWhereFacesSlideAlongAnArc) {
  constexpr double radius = 20;
  Faces faces;
  for (int i = 0; i < 24; ++i) {
    const Eigen::Vector3d normal(std::cos(i * spacing / radius), std::sin(i * spacing / radius), 0);
    faces.add(radius * normal, normal);
  }
  FaceGaps gaps = faces.gaps();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5 * spacing / radius, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  gaps.move(faces.moved([&](const auto& x, Eigen::Index side) -> Eigen::RowVector3d {
    return side == 0 ? Eigen::RowVector3d(x * turn.transpose()) : Eigen::RowVector3d(x);
  }));
  EXPECT_LE(gaps.gaps().segment(8, 32).cwiseAbs().maxCoeff(), 5e-4);
}

TEST(FaceGaps, LinkAFaceNodeToThoseOppositeByShares) {
  const Faces faces = line();
  FaceGaps gaps = faces.gaps();
  gaps.move(faces.moved([](const auto& x, Eigen::Index side) -> Eigen::RowVector3d {
    return x + Eigen::RowVector3d(side == 0 ? 0.3 : 0, 0, 0);
  }));
  for (const Eigen::Index face : {10, 11}) {
    std::vector<FaceGaps::Link> links;
    gaps.append_links(face, links);
    ASSERT_GE(links.size(), 2U);
    double shares = 0, place = 0;
    for (const FaceGaps::Link& link : links) {
      EXPECT_EQ(link.face, face);
      EXPECT_NE(link.opposite % 2, face % 2);
      EXPECT_LE((link.direction - Eigen::Vector3d(0, face % 2 == 0 ? 1 : -1, 0)).norm(), 1e-9) << "out of the opposite";
      shares += link.share;
      place += link.share * (faces.nodes(link.opposite, 0) + (face % 2 == 0 ? 0 : 0.3));
    }
    EXPECT_NEAR(shares, 1, 1e-12);
    EXPECT_NEAR(place, 5 + (face % 2 == 0 ? 0.3 : 0), 0.05) << "about where the node is now";
  }
}

/// Of which more neighbours on its own wall are nearer than a node of the opposite one.
TEST(FaceGaps, OfACavityAreSeenFromAFineWallToACoarseOne) {
  constexpr double fine = 0.1, apart = 0.5;
  std::vector<FacePlace> places;
  const auto add_wall = [&](double y, double normal, double step) {
    const int half = static_cast<int>(2 / step);
    for (int i = -half; i <= half; ++i) {
      for (int k = -half; k <= half; ++k) {
        places.push_back({{i * step, y, k * step}, normal * Eigen::Vector3d::UnitY(), step});
      }
    }
  };
  add_wall(0, -1, fine);
  const auto below = static_cast<Eigen::Index>(places.size());
  add_wall(3, 1, spacing);
  Points nodes(static_cast<Eigen::Index>(places.size()), 3);
  for (Eigen::Index f = 0; f < nodes.rows(); ++f) {
    nodes.row(f) = places[static_cast<std::size_t>(f)].place;
  }
  FaceGaps gaps(places, nodes, solve::Faces::of_cavity);
  gaps.move(nodes);
  EXPECT_TRUE(gaps.gaps().array().isInf().all()) << "out of reach";
  nodes.bottomRows(nodes.rows() - below).col(1).array() = apart;
  gaps.move(nodes);
  EXPECT_LE((gaps.gaps().head(below).array() - apart).abs().maxCoeff(), 1e-9);
}

}  // namespace brainshift::solve::face_gaps_test
