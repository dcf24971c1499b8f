// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/rasteriser.hpp"

#include <gtest/gtest.h>

namespace brainshift::pipelines::rasteriser_test {

using Eigen::Vector3d;

// Two squares across the line of sight, which goes along +y: the nearer one at y = 0, 20 mm wide, the other at y = 10,
// 40 mm wide.
Surface two_squares() {
  Surface surface{Points(8, 3), Triangles(4, 3)};
  surface.vertices << -10, 0, -10, 10, 0, -10, 10, 0, 10, -10, 0, 10, -20, 10, -20, 20, 10, -20, 20, 10, 20, -20, 10,
      20;
  surface.triangles << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7;
  return surface;
}

const Camera from_the_front = look_at({0, 0, 0}, Vector3d::UnitY(), 1, 60, 60);

TEST(Rasteriser, LooksAtTheTargetWithThePatientUpright) {
  EXPECT_TRUE(from_the_front.up.isApprox(Vector3d::UnitZ()));
  EXPECT_TRUE(from_the_front.project({0, 0, 0}).isApprox(Vector3d(30, 30, 0)));
  EXPECT_TRUE(from_the_front.project({0, 5, 10}).isApprox(Vector3d(30, 20, 5))) << "superior is up, behind is deeper";
  EXPECT_TRUE(look_at({0, 0, 0}, -Vector3d::UnitZ(), 1, 9, 9).up.isApprox(-Vector3d::UnitY())) << "anterior is up";
}

TEST(Rasteriser, TheNearerSurfaceHidesTheOther) {
  const ColourScale scale{.low = 0, .high = 1};
  const DepthCanvas picture = draw_surface(from_the_front, two_squares(), {0, 0, 0, 0, 1, 1, 1, 1}, scale);
  ASSERT_EQ(picture.canvas.width, 60);
  const auto redness = [&](int x, int y) { return picture.canvas.at(x, y)[0] - picture.canvas.at(x, y)[1]; };
  EXPECT_LT(redness(30, 30), 10) << "the nearer one, pale";
  EXPECT_GT(redness(15, 30), 50) << "the farther one, dark red";
  EXPECT_EQ(picture.canvas.at(3, 30), colour::white) << "beside both";
}

TEST(Rasteriser, LinesAreSeenWhereNothingHidesThem) {
  const DepthCanvas picture = draw_surface(from_the_front, two_squares(), std::vector<double>(8, 0.0), {});
  const auto seen = [&](const Vector3d& from, const Vector3d& to) {
    Points line(2, 3);
    line << from.transpose(), to.transpose();
    return visible_parts(picture, from_the_front, line).size() == 1;
  };
  EXPECT_TRUE(seen({-1, -5, 0}, {1, -5, 0})) << "before both";
  EXPECT_TRUE(seen({-1, 1.5, 0}, {1, 1.5, 0})) << "on the nearer one";
  EXPECT_FALSE(seen({-1, 5, 0}, {1, 5, 0})) << "behind it";
  EXPECT_TRUE(seen({14, 5, 0}, {16, 5, 0})) << "beside it";
}

}  // namespace brainshift::pipelines::rasteriser_test
