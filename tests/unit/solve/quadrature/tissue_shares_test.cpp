// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/tissue_shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/gauss_points.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/unit/solve/quarter_cell.hpp"

namespace brainshift::solve::tissue_shares_test {

using test::box_cells;

constexpr double side = 12;
const std::vector<std::int32_t> tissues = {1, 2};

/// Voxels of 1 mm over the box, and a few beyond it.
LabelMap labelled(const std::function<std::uint16_t(const Eigen::Vector3d&)>& label) {
  LabelMap labels;
  labels.geometry.size = {16, 16, 16};
  labels.geometry.origin.setConstant(-1.5);
  for (int k = 0; k < 16; ++k) {
    for (int j = 0; j < 16; ++j) {
      for (int i = 0; i < 16; ++i) {
        labels.voxels.push_back(label(labels.geometry.to_world(Eigen::Vector3d(i, j, k))));
      }
    }
  }
  return labels;
}

std::map<std::int32_t, double> volumes(const IntegrationPoints& points) {
  std::map<std::int32_t, double> of;
  for (std::size_t i = 0; i < points.size(); ++i) {
    of[points.label[i]] += points.volume[i];
  }
  return of;
}

Eigen::Vector3d first_moment(const IntegrationPoints& points) {
  return points.positions.transpose() *
         Eigen::Map<const Eigen::VectorXd>(points.volume.data(), std::ssize(points.volume));
}

struct Cells {
  const char* name;
  BackgroundCells cells;
  int points;
};

std::vector<Cells> all_kinds() {
  const auto tetrahedra = test::box_tetrahedra(test::irregular_box(4, side), 4);
  return {{"hexahedra", box_cells(3, side), 8},
          {"hexahedra with a point each", box_cells(3, side), 1},
          {"tetrahedra", tetrahedra, 4}};
}

/// A plane of voxels' faces that runs through all cells about it.
TEST(TissueShares, TellTheVolumeOfEachTissueAndKeepThatAndTheCentroidOfAll) {
  const LabelMap labels = labelled([](const auto& x) { return x[0] < 5 ? 1 : 2; });
  for (const auto& [name, cells, count] : all_kinds()) {
    const IntegrationPoints whole = integration_points(cells, count, nullptr, tissues);
    const IntegrationPoints parted = integration_points(cells, count, &labels, tissues);
    const auto of = volumes(parted);
    EXPECT_NEAR(of.at(1), 5 * side * side, 0.03 * side * side * side) << name;
    EXPECT_NEAR(of.at(1) + of.at(2), side * side * side, 1e-9) << name;
    EXPECT_LT((first_moment(parted) - first_moment(whole)).norm(), 1e-9 * side * side * side * side) << name;
    for (std::size_t i = 0; i < parted.size(); ++i) {  // a Gauss point is not the centroid of what is nearest to it
      const double beyond = parted.positions(static_cast<Eigen::Index>(i), 0) - 5;
      EXPECT_LT(parted.label[i] == 1 ? beyond : -beyond, 0.5) << name;
    }
  }
}

/// As that between the ventricles: its voxels' middles lie where no point is.
TEST(TissueShares, KeepASheetThatIsThinnerThanPointsLieApart) {
  const LabelMap labels = labelled([](const auto& x) { return x[2] > 6 && x[2] < 7 ? 2 : 1; });
  const IntegrationPoints points = integration_points(box_cells(3, side), 8, &labels, tissues);
  EXPECT_NEAR(volumes(points).at(2), side * side, 0.05 * side * side);
}

TEST(TissueShares, LeavePointsAloneWhereTissuesEndBetweenCells) {
  const LabelMap labels = labelled([](const auto& x) { return x[1] < 8 ? 1 : 2; });
  for (const int count : {1, 8}) {
    const BackgroundCells cells = box_cells(3, side);
    const IntegrationPoints whole = integration_points(cells, count, nullptr, tissues);
    const IntegrationPoints points = integration_points(cells, count, &labels, tissues);
    EXPECT_EQ(points.positions, whole.positions);
    EXPECT_EQ(points.volume, whole.volume);
    EXPECT_DOUBLE_EQ(volumes(points).at(2), side * side * side / 3);
  }
}

TEST(TissueShares, CountNothingThatIsNoTissue) {
  const LabelMap labels = labelled([](const auto& x) { return x[0] < 3 ? 1 : x[0] < 6 ? 7 : 2; });
  const IntegrationPoints points = integration_points(box_cells(1, side), 1, &labels, tissues);
  const auto of = volumes(points);
  EXPECT_DOUBLE_EQ(of.at(1), side * side * side / 3);
  EXPECT_DOUBLE_EQ(of.at(2), side * side * side * 2 / 3);
}

/// Of a cell that the surface cuts only what is inside counts, with the volume that it has.
TEST(TissueShares, OfACutCellHaveItsInsideVolume) {
  const BackgroundCells cells = test::cell_cut_at_a_quarter(side);
  const LabelMap labels = labelled([](const auto& x) { return x[1] < 4 ? 1 : 2; });
  const IntegrationPoints whole = integration_points(cells, 8, nullptr, tissues);
  const IntegrationPoints parted = integration_points(cells, 8, &labels, tissues);
  const double all = std::accumulate(whole.volume.begin(), whole.volume.end(), 0.0);
  EXPECT_GT(parted.size(), whole.size());
  EXPECT_NEAR(volumes(parted).at(1), all / 3, 0.05 * all);
  EXPECT_NEAR(volumes(parted).at(1) + volumes(parted).at(2), all, 1e-12 * all);
  EXPECT_LT((first_moment(parted) - first_moment(whole)).norm(), 1e-12 * all * side);
}

/// Also of cells of an odd number of voxels: no sample lies midway between two points, where rounding would choose.
TEST(TissueShares, DoNotDependOnWhereTheBodyLies) {
  for (const int voxels : {4, 5, 6, 7, 8}) {
    for (const double away : {0.0, 0.1, 17.3, -101.7, 1000.3}) {
      BackgroundCells cells = box_cells(1, voxels);
      cells.vertices.array() += away;
      LabelMap labels;
      labels.geometry.size.setConstant(voxels);
      labels.geometry.origin.setConstant(away + 0.5);
      labels.voxels.assign(labels.geometry.voxel_count(), 2);
      std::fill_n(labels.voxels.begin(), 3 * voxels * voxels, std::uint16_t{1});  // of the lowest three layers
      const auto of = volumes(integration_points(cells, 8, &labels, tissues));
      EXPECT_NEAR(of.at(1) / (voxels * voxels), 3, 0.5) << voxels << " " << away;
    }
  }
}

/// Tetrahedra of one cube are sampled evenly: shares of slabs across it are those of the slabs.
TEST(TissueShares, OfTetrahedraAreEven) {
  const BackgroundCells cells = test::box_tetrahedra(test::irregular_box(2, side), 2);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double below : {3.0, 6.0, 9.0}) {
      const LabelMap labels = labelled([&](const auto& x) { return x[axis] < below ? 1 : 2; });
      const auto of = volumes(integration_points(cells, 1, &labels, tissues));
      EXPECT_NEAR(of.at(1), below * side * side, 0.03 * side * side * side) << axis << " " << below;
    }
  }
}

/// A few voxels of a tissue far from the rest of it make no point: it would be merged into the rest, far away.
TEST(TissueShares, MakeNothingOfSpecks) {
  const LabelMap labels = labelled([](const auto& x) {
    const bool speck = x[0] > 9 && x[0] < 10 && x[1] > 9 && x[1] < 10 && x[2] > 9 && x[2] < 10;
    return x.maxCoeff() < 4 || speck ? 2 : 1;
  });
  const IntegrationPoints points = integration_points(box_cells(3, side), 1, &labels, tissues);
  EXPECT_EQ(points.size(), 27u);
  EXPECT_DOUBLE_EQ(volumes(points).at(2), side * side * side / 27);
}

/// The point itself lies in a voxel that is no tissue: what is about it says more than the cell's label.
TEST(TissueShares, OfAPointInNoTissueAreThoseAboutIt) {
  const LabelMap labels = labelled([](const auto& x) { return x.x() > 5 && x.x() < 7 ? 9 : x.y() < 6 ? 1 : 2; });
  const IntegrationPoints points = integration_points(box_cells(1, side), 8, &labels, tissues);
  ASSERT_EQ(points.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(points.label[i], points.positions(static_cast<Eigen::Index>(i), 1) < 6 ? 1 : 2);
  }
}

TEST(TissueShares, InThePlaneTellTheAreaOfEachTissue) {
  const LabelMap labels = labelled([](const auto& x) { return x[0] < 5 ? 1 : 2; });
  const NodeCloud cloud = test::irregular_rectangle(4, 4, side, side);
  for (const BackgroundCells& cells :
       {test::rectangle_cells(3, 3, side, side), test::rectangle_triangles(cloud, 4, 4)}) {
    for (const int count : {1, most_points_per_cell(cells.kind)}) {
      const auto of = volumes(integration_points(cells, count, &labels, tissues));
      EXPECT_NEAR(of.at(1), 5 * side, 0.03 * side * side) << count;
      EXPECT_NEAR(of.at(1) + of.at(2), side * side, 1e-9) << count;
    }
  }
}

}  // namespace brainshift::solve::tissue_shares_test
