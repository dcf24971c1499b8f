// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/stiff_parts.hpp"

#include <gtest/gtest.h>

#include "solve/body/soft_nodes.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::solve::stiff_parts_test {

constexpr double side = model_side, softest = 10;
constexpr int along = 24;

using Parts = std::vector<std::vector<std::int32_t>>;

/// A cube of nodes in whose points the modulus is what a function of their place says.
struct Cube {
  NodeCloud cloud = test::irregular_box(9, side);
  std::vector<double> of_point, of_node;
  ShapeRows rows;
  std::vector<std::uint8_t> held = std::vector<std::uint8_t>(cloud.size(), 0);

  template <class Modulus>
  explicit Cube(const Modulus& modulus) {
    Points places(along * along * along, 3);
    for (Eigen::Index p = 0; p < places.rows(); ++p) {
      const Eigen::Array3d index(static_cast<double>(p % along), static_cast<double>(p / along % along),
                                 static_cast<double>(p / (along * along)));
      places.row(p) = side / along * (index + 0.5);
      of_point.push_back(modulus(Eigen::Vector3d(places.row(p))));
    }
    rows = ShapeFunctions(cloud.positions, cloud.spacing, {}).evaluate(places, false);
    of_node = moduli_at_nodes(std::vector<double>(of_point.size(), 1.0), of_point, rows, cloud.size());
  }

  Parts parts() const { return stiff_parts(of_point, of_node, rows, held); }
};

/// Modulus of two balls of radius 14 in opposite corners, and about them.
auto two_balls(double first, double second) {
  return [=](const Eigen::Vector3d& x) {
    const auto in_ball = [&](double at) { return (x - Eigen::Vector3d::Constant(at)).norm() < 14; };
    return in_ball(15) ? first : in_ball(45) ? second : softest;
  };
}

TEST(StiffParts, AreWhatHangsTogether) {
  const Cube cube(two_balls(1000, 1000));
  const Parts parts = cube.parts();
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_GE(parts[0].size(), parts[1].size());
  for (const auto& part : parts) {
    const bool low = cube.cloud.positions(part[0], 0) < side / 2;
    for (const std::int32_t a : part) {
      const Eigen::Vector3d x = cube.cloud.positions.row(a);
      EXPECT_LT((x - Eigen::Vector3d::Constant(low ? 15 : 45)).norm(), 14 + 4) << x.transpose();
    }
  }
}

TEST(StiffParts, AreThirtyTimesAsStiffAndMore) {
  EXPECT_EQ(Cube(two_balls(29 * softest, 31 * softest)).parts().size(), 1U);
  EXPECT_TRUE(Cube(two_balls(softest, softest)).parts().empty());
}

TEST(StiffParts, OfStepsOfStiffnessAreApart) {
  const Parts parts = Cube([](const Eigen::Vector3d& x) {
                        const double off = (x - Eigen::Vector3d::Constant(side / 2)).norm();
                        return off < 12 ? 1e6 * softest : off < 22 ? 1e3 * softest : softest;
                      }).parts();
  EXPECT_EQ(parts.size(), 2U);
}

TEST(StiffParts, AreNotThoseThatAreHeldNorMostOfTheBody) {
  Cube cube(two_balls(1000, 1000));
  cube.held[static_cast<std::size_t>(cube.parts()[0].back())] = 1;
  EXPECT_EQ(cube.parts().size(), 1U);
  const Cube nearly_all([](const Eigen::Vector3d& x) { return x.norm() < 20 ? softest : 1000; });
  EXPECT_TRUE(nearly_all.parts().empty());
  const Cube on_a_base([](const Eigen::Vector3d& x) { return x[2] < 15 ? softest : 1000; });
  EXPECT_EQ(on_a_base.parts().size(), 1U) << "three quarters of the body rock on the rest";
}

}  // namespace brainshift::solve::stiff_parts_test
