// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/body/check_surface.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "segmentation/geometry/joined.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::discretise::check_surface_test {

using test::box;

const Surface body = box({0, 0, 0}, {10, 20, 30});

std::string fault(const Surface& surface) {
  return test::refusal([&] { check_encloses_body(surface); });
}

TEST(CheckSurface, LetsPassWhatEnclosesABody) {
  EXPECT_EQ(fault(body), "");
  EXPECT_EQ(fault(test::sphere({900, -700, 60}, 40, 3)), "");
  EXPECT_EQ(fault(joined(body, box({20, 0, 0}, {30, 10, 10}))), "") << "two bodies";
  Surface unused = body;
  unused.vertices.conservativeResize(9, 3);
  unused.vertices.row(8) << 50, 0, 0;
  EXPECT_EQ(fault(unused), "") << "a vertex without a triangle";
}

TEST(CheckSurface, RefusesNumbersThatAreNone) {
  Surface wrong = body;
  wrong.vertices(5, 1) = std::numeric_limits<double>::infinity();
  EXPECT_NE(fault(wrong).find("not finite at vertex 5"), std::string::npos);
  for (const std::int32_t vertex : {-1, 8}) {
    wrong = body;
    wrong.triangles(3, 2) = vertex;
    EXPECT_NE(fault(wrong).find("does not exist"), std::string::npos);
  }
  wrong.triangles = body.triangles.topRows(3).eval();
  EXPECT_NE(fault(wrong).find("3 triangles"), std::string::npos);
}

TEST(CheckSurface, CountsTheEdgesOfAHole) {
  Surface open = body;
  open.triangles = body.triangles.topRows(11).eval();
  EXPECT_NE(fault(open).find("3 edges"), std::string::npos);
  open.triangles = body.triangles.topRows(10).eval();
  EXPECT_NE(fault(open).find("4 edges"), std::string::npos) << "the two triangles of a side";
}

TEST(CheckSurface, RefusesTrianglesThatDoNotAgree) {
  Surface wrong = body;
  wrong.triangles.row(4).reverseInPlace();
  EXPECT_NE(fault(wrong).find("agree in orientation"), std::string::npos);
  wrong = body;
  wrong.triangles.conservativeResize(13, 3);
  wrong.triangles.row(12) << 0, 1, 7;
  EXPECT_NE(fault(wrong).find("2-manifold"), std::string::npos) << "a fin";
}

TEST(CheckSurface, RefusesASurfaceThatCutsItself) {
  EXPECT_NE(fault(joined(body, box({5, 5, 5}, {15, 15, 15}))).find("intersects itself"), std::string::npos);
  Surface spike = body;
  spike.vertices.row(0) << 15, 25, 35;
  EXPECT_NE(fault(spike).find("intersects itself"), std::string::npos);
}

Surface flipped(Surface surface) {
  surface.triangles.col(0).swap(surface.triangles.col(1));
  return surface;
}

const Surface within = box({2, 2, 2}, {4, 4, 4}), beside = box({20, 0, 0}, {22, 2, 2});

TEST(CheckSurface, LetsPassACavityAndABodyWithinIt) {
  const Surface hollow = joined(box({0, 0, 0}, {30, 30, 30}), flipped(box({5, 5, 5}, {25, 25, 25})));
  EXPECT_EQ(fault(hollow), "");
  EXPECT_EQ(fault(joined(hollow, box({10, 10, 10}, {20, 20, 20}))), "");
}

TEST(CheckSurface, RefusesASurfaceThatIsInsideOut) {
  for (const Surface& turned : {flipped(body), flipped(joined(body, beside)), joined(flipped(body), within)}) {
    EXPECT_NE(fault(turned).find("is inside out: "), std::string::npos) << fault(turned);
    EXPECT_NE(fault(turned).find("flip them"), std::string::npos) << "all of its shells";
  }
}

TEST(CheckSurface, NamesTheShellThatFacesTheWrongWay) {
  const std::string last = "shell 2 of 2 faces the wrong way, that of triangle 12; flip the triangles of this shell";
  EXPECT_NE(fault(joined(body, within)).find(last), std::string::npos) << "a cavity that faces outward";
  EXPECT_NE(fault(joined(body, flipped(beside))).find(last), std::string::npos) << "a stray one that faces inward";
  EXPECT_NE(fault(joined(flipped(beside), body)).find("shell 1 of 2 faces the wrong way"), std::string::npos);
  EXPECT_NE(fault(joined(flipped(body), beside)).find("shell 1 of 2"), std::string::npos) << "the largest";
  const Surface three = joined(joined(body, flipped(within)), flipped(beside));
  EXPECT_NE(fault(three).find("shell 3 of 3 faces the wrong way, that of triangle 24"), std::string::npos);
}

}  // namespace brainshift::discretise::check_surface_test
