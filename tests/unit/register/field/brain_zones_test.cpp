// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/brain_zones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::brain_zones_test {

using namespace builders;

constexpr double fade = 15;
constexpr double faceted =
    0.6;  // mm: the ball's facets lie inside the sphere, and distances between samples are rounded

TEST(BrainZones, GoByTheDistanceFromTheSurface) {
  const ImageGeometry g = grid({40, 36, 34}, {2, 2.2, 2.4}, oblique());
  const BrainZones zones = brain_zones(ball(centre, radius), g, fade);
  EXPECT_NEAR(zones.shell, 2 * g.spacing.norm(), 1e-12) << "two voxel diagonals";
  int seen[5] = {};
  for_each_voxel(g, [&](const Eigen::Vector3d& x, std::size_t v) {
    const double distance = (x - centre).norm() - radius;
    const double limits[] = {0, zones.shell, fade};
    if (std::any_of(std::begin(limits), std::end(limits),
                    [&](double limit) { return std::abs(distance - limit) < faceted; })) {
      return;
    }
    const Zone expected = distance < 0             ? Zone::brain
                          : distance < zones.shell ? Zone::shell
                          : distance < fade        ? Zone::fading
                                                   : Zone::beyond;
    ASSERT_EQ(static_cast<int>(zones.zone[v]), static_cast<int>(expected)) << distance << " mm from the surface";
    ++seen[static_cast<int>(expected)];
  });
  EXPECT_EQ(std::exchange(seen[static_cast<int>(Zone::cavity)], 1000), 0) << "nothing was taken out";
  EXPECT_GT(*std::min_element(std::begin(seen), std::end(seen)), 100) << "every other zone occurs";
}

TEST(BrainZones, HaveACavityAsFarAsItsWall) {
  constexpr double taken_out = 12;
  const ImageGeometry g = grid({40, 36, 34}, {2, 2.2, 2.4}, oblique());
  const Surface wall = ball(centre, taken_out);
  const BrainZones zones = brain_zones(ball(centre, radius), g, fade, &wall);
  int inside = 0;
  for_each_voxel(g, [&](const Eigen::Vector3d& x, std::size_t v) {
    const double distance = (x - centre).norm() - taken_out;
    if (std::abs(distance) > faceted) {
      ASSERT_EQ(zones.zone[v] == Zone::cavity, distance < 0) << distance << " mm from the wall";
      inside += distance < 0 ? 1 : 0;
    }
  });
  EXPECT_GT(inside, 100);
}

TEST(BrainZones, TellTheDistanceAsFarAsTheFieldFades) {
  const BrainZones zones = brain_zones(ball(centre, radius), grid(), fade);
  const Eigen::Vector3d out = Eigen::Vector3d(1, 2, -2) / 3;
  for (const double distance : {-5.0, 1.0, 8.0, fade}) {
    EXPECT_NEAR(zones.outside.value(centre + (radius + distance) * out), distance, faceted);
  }
}

TEST(BrainZones, NeedAFadeWiderThanTheShell) {
  const Surface brain = ball(centre, radius);
  const double shell = 2 * grid().spacing.norm();
  const std::string fault = test::refusal([&] { brain_zones(brain, grid(), shell); });
  EXPECT_NE(fault.find("two voxel diagonals"), std::string::npos) << fault;
  EXPECT_EQ(test::refusal([&] { brain_zones(brain, grid(), shell + 0.01); }), "");
}

TEST(BrainZones, NeedABrainInTheImageAndAClosedOne) {
  const Surface elsewhere = ball(centre + Eigen::Vector3d(300, 0, 0), radius);
  const std::string fault = test::refusal([&] { brain_zones(elsewhere, grid(), fade); });
  EXPECT_NE(fault.find("encloses no voxel"), std::string::npos) << fault;
  Surface open = ball(centre, radius);
  open.triangles.conservativeResize(open.triangles.rows() - 1, Eigen::NoChange);
  EXPECT_THROW(brain_zones(open, grid(), fade), std::invalid_argument);
}

}  // namespace brainshift::registration::brain_zones_test
