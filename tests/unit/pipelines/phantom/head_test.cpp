// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/head.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <random>

#include "segmentation/interface/options.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::head_test {

using Eigen::Vector3d;
namespace tissue = segmentation::default_label;

const Vector3d centre(10, -20, 30);

/// Calls visit(place) at the middles of cubes of an edge (mm) that fill a box of half this size around the centre.
template <class Visit>
void for_places(double half, double edge, const Visit& visit) {
  for (double z = -half + edge / 2; z < half; z += edge) {
    for (double y = -half + edge / 2; y < half; y += edge) {
      for (double x = -half + edge / 2; x < half; x += edge) {
        visit(Vector3d(centre + Vector3d(x, y, z)));
      }
    }
  }
}

/// Volume of what lies below level 1, by counting.
template <class Shape>
double counted(const Shape& shape, double half, double edge) {
  double places = 0;
  for_places(half, edge, [&](const Vector3d& place) { places += shape.level(place) <= 1 ? 1 : 0; });
  return places * edge * edge * edge;
}

TEST(Egg, HasItsBoundaryWhereItsLengthsSay) {
  const Egg egg{.centre = centre, .half_width = 3, .half_length = 5, .height = 4, .depth = 2, .taper = 0.2};
  EXPECT_EQ(egg.level(centre), 0);
  for (const Vector3d& offset : {Vector3d(3, 0, 0), Vector3d(-3, 0, 0), Vector3d(0, 5, 0), Vector3d(0, -5, 0),
                                 Vector3d(0, 0, 4), Vector3d(0, 0, -2)}) {
    EXPECT_NEAR(egg.level(centre + offset), 1, 1e-12);
    EXPECT_LT(egg.level(centre + 0.99 * offset), 1);
  }
  EXPECT_LT(egg.level(centre + Vector3d(2, 3, 0)), egg.level(centre + Vector3d(2, -3, 0))) << "wider at the back";
}

TEST(Egg, HoldsTheVolumeThatItSaysWhateverItsTaper) {
  for (const double taper : {0.0, 0.1, 0.5}) {
    const Egg egg{.centre = centre, .half_width = 3, .half_length = 5, .height = 4, .depth = 2, .taper = taper};
    EXPECT_NEAR(counted(egg, 6, 0.15), egg.volume(), 0.005 * egg.volume()) << taper;
  }
}

TEST(Ellipsoid, HoldsTheVolumeThatItSaysInItsOwnAxes) {
  const Ellipsoid shape{.centre = centre,
                        .semi_axes = {2, 5, 3},
                        .axes = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).toRotationMatrix()};
  EXPECT_NEAR(counted(shape, 5.1, 0.15), shape.volume(), 0.005 * shape.volume());
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(shape.level(centre + shape.semi_axes[axis] * shape.axes.col(axis)), 1, 1e-12);
  }
}

TEST(Head, IsNestedAsItsVolumesAssume) {
  for (const double gap : {0.0, 3.0}) {
    const Head head = make_head(centre, 0.5, gap);
    for_places(50, 2.5, [&](const Vector3d& place) {
      const double levels[] = {head.skin.level(place), head.skull.level(place), head.skull_inside.level(place),
                               head.brain.level(place)};
      ASSERT_TRUE(std::is_sorted(std::begin(levels), std::end(levels)));
      const bool left = head.ventricles[0].level(place) <= 1, right = head.ventricles[1].level(place) <= 1;
      const bool tumour = head.tumour.level(place) <= 1;
      ASSERT_LE(int{left} + int{right} + int{tumour}, 1) << "they do not meet";
      if (left || right || tumour) {
        ASSERT_LT(head.brain.level(place), 1);
      }
    });
  }
}

TEST(Head, EveryTissueHasTheVolumeThatItSays) {
  const Head head = make_head(centre, 0.5, 4);
  constexpr double edge = 0.9;
  std::array<double, 7> volume{};
  for_places(50, edge, [&](const Vector3d& place) {
    volume[static_cast<std::size_t>(tissue_at(head, place))] += edge * edge * edge;
  });
  for (const std::uint16_t label :
       {tissue::parenchyma, tissue::ventricles, tissue::tumour, tissue::csf, tissue::skull, tissue::skin}) {
    const double exact = tissue_volume(head, label);
    EXPECT_NEAR(volume[static_cast<std::size_t>(label)], exact, 0.02 * exact) << label;
  }
  EXPECT_THROW(tissue_volume(head, 9), std::invalid_argument);
}

TEST(Head, OfAnotherScaleAndPlaceIsTheSameShape) {
  const Head small = make_head(Vector3d::Zero(), 0.5, 2), large = make_head(centre, 1, 2);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-90, 90);
  for (int i = 0; i < 500; ++i) {
    const Vector3d x(within(random), within(random), within(random));
    ASSERT_EQ(tissue_at(small, 0.5 * x), tissue_at(large, centre + x));
  }
  EXPECT_NEAR(8 * tissue_volume(small, tissue::csf), tissue_volume(large, tissue::csf), 1e-6);
}

TEST(Head, WithoutAGapHasNoFluid) {
  EXPECT_NEAR(tissue_volume(make_head(centre, 1, 0), tissue::csf), 0, 1e-6);
  EXPECT_GT(tissue_volume(make_head(centre, 1, 3), tissue::csf), 1e5);
}

}  // namespace brainshift::pipelines::head_test
