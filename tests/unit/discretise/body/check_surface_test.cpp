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

TEST(CheckSurface, RefusesASurfaceThatIsInsideOut) {
  Surface turned = body;
  turned.triangles.col(0).swap(turned.triangles.col(1));
  EXPECT_NE(fault(turned).find("inside out"), std::string::npos);
  Surface second = box({20, 0, 0}, {22, 2, 2});
  second.triangles.col(0).swap(second.triangles.col(1));
  EXPECT_NE(fault(joined(body, second)).find("inside out"), std::string::npos) << "one of two bodies";
}

}  // namespace brainshift::discretise::check_surface_test
