// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/cell_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "solve/quadrature/integration_points.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::solve::cell_points_test {

using test::box_cells;

constexpr double side = 12;
const std::vector<std::int32_t> tissues = {1, 2};

TEST(IntegrationPoints, FillTheVolume) {
  for (const int n : {1, 8}) {
    const IntegrationPoints points = integration_points(box_cells(4, side), n, nullptr, tissues);
    EXPECT_EQ(points.size(), 64u * static_cast<std::size_t>(n));
    EXPECT_NEAR(std::accumulate(points.volume.begin(), points.volume.end(), 0.0), side * side * side, 1e-9);
  }
}

TEST(IntegrationPoints, TakeTheTissueOfTheLabelMapAndElseOfTheirCell) {
  LabelMap labels;
  labels.geometry.size = {12, 12, 12};
  labels.geometry.origin.setConstant(0.5);
  labels.voxels.assign(labels.geometry.voxel_count(), 2);
  labels.at(0, 0, 0) = 9;  // no tissue
  const IntegrationPoints points = integration_points(box_cells(12, side), 1, &labels, tissues);
  EXPECT_EQ(points.labelled_by_cell, 1u);
  EXPECT_EQ(points.label.front(), 1);
  EXPECT_EQ(std::count(points.label.begin(), points.label.end(), 2), 12 * 12 * 12 - 1);
}

TEST(IntegrationPoints, TakeNoTissueFromABackground) {
  const std::vector<std::int32_t> with_background = {0, 1, 2};
  LabelMap labels;
  labels.geometry.size.setConstant(12);
  labels.voxels.assign(labels.geometry.voxel_count(), 0);
  for (const LabelMap* map : {static_cast<const LabelMap*>(nullptr), static_cast<const LabelMap*>(&labels)}) {
    const IntegrationPoints points = integration_points(box_cells(4, side), 1, map, with_background);
    EXPECT_EQ(std::ranges::count(points.label, 1), 4 * 4 * 4) << "the cells' own";
  }
}

TEST(IntegrationPoints, RefuseANumberThatTheCellsDoNotTake) {
  EXPECT_THROW(integration_points(box_cells(2, side), 4, nullptr, tissues), std::invalid_argument);
}

}  // namespace brainshift::solve::cell_points_test
