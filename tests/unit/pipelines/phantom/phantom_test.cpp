// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/phantom.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "segmentation/interface/options.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::phantom_test {

using brainshift::test::refusal;
namespace tissue = segmentation::default_label;

constexpr PhantomOptions small{.size = 32, .spacing = 6};

TEST(Phantom, IsTheSameHeadInEveryFrame) {
  const Phantom oblique = make_phantom(small);
  const Phantom mirrored = make_phantom({.size = 32, .spacing = 6, .frame = PhantomFrame::mirrored});
  EXPECT_EQ(oblique.head.tumour.centre, mirrored.head.tumour.centre);
  EXPECT_EQ(oblique.load.displacement, mirrored.load.displacement);
  for (const Phantom& phantom : {oblique, mirrored}) {
    const ImageGeometry& grid = phantom.geometry;
    EXPECT_TRUE((grid.direction * grid.direction.transpose()).isIdentity(1e-12));
    const Eigen::Vector3d middle = grid.to_world(Eigen::Vector3d::Constant(15.5));
    EXPECT_LT((middle - phantom.head.brain.centre).norm(), 1e-9);
  }
  EXPECT_NEAR(oblique.geometry.direction.determinant(), 1, 1e-12);
  EXPECT_LT(oblique.geometry.direction.diagonal().maxCoeff(), 0.999) << "it is turned";
  EXPECT_NEAR(mirrored.geometry.direction.determinant(), -1, 1e-12);
}

TEST(Phantom, GrowsWithItsImage) {
  EXPECT_DOUBLE_EQ(make_phantom(small).head.scale, 1);
  EXPECT_DOUBLE_EQ(make_phantom({.size = 48, .spacing = 1}).head.scale, 0.25);
}

TEST(Phantom, HasItsLandmarksInTheBrain) {
  for (const auto& [name, position] : make_phantom(small).landmarks) {
    const std::uint16_t label = tissue_at(make_phantom(small).head, position);
    EXPECT_TRUE(label == tissue::parenchyma || label == tissue::ventricles || label == tissue::tumour) << name;
    EXPECT_EQ(label == tissue::ventricles, name.ends_with("ventricle")) << name;
    EXPECT_EQ(label == tissue::tumour, name == "tumour") << name;
  }
}

TEST(Phantom, RefusesOptionsOutOfRange) {
  EXPECT_EQ(refusal([] { make_phantom({.size = 23}); }), "size is '23', but must be a whole number from 24 to 1024");
  EXPECT_NE(refusal([] { make_phantom({.spacing = 0.1}); }).find("spacing is '0.1'"), std::string::npos);
  EXPECT_NE(refusal([] { make_phantom({.size = 24, .spacing = 0.25}); }).find("size times spacing is 6 mm"),
            std::string::npos);
  EXPECT_NE(refusal([] { make_phantom({.csf_gap = 4.5}); }).find("(mm)"), std::string::npos);
}

TEST(Phantom, ItsLabelsHoldTheVolumesThatAreKnown) {
  const Phantom phantom = make_phantom({.size = 64, .spacing = 3, .csf_gap = 4});
  const LabelMap labels = sample_labels(phantom);
  EXPECT_TRUE(same_geometry(labels.geometry, phantom.geometry));
  for (const std::uint16_t label : {tissue::parenchyma, tissue::tumour, tissue::skull, tissue::skin}) {
    const double voxels = static_cast<double>(std::ranges::count(labels.voxels, label));
    const double exact = tissue_volume(phantom.head, label);
    EXPECT_NEAR(voxels * 27, exact, 0.05 * exact) << label;
  }
  EXPECT_EQ(label_at(labels, phantom.head.tumour.centre), tissue::tumour);
}

TEST(Phantom, ItsImageIsTheMeanOverEachVoxelAndOfItsSeed) {
  const Phantom phantom = make_phantom({.size = 24, .spacing = 8});
  const ScalarImage t1 = sample_t1(phantom, 1);
  double sum = 0;
  for (const double z : {-0.25, 0.25}) {
    for (const double y : {-0.25, 0.25}) {
      for (const double x : {-0.25, 0.25}) {
        sum += t1_intensity(phantom.head, phantom.geometry.to_world(Eigen::Vector3d(14 + x, 9 + y, 12 + z)), 1);
      }
    }
  }
  EXPECT_NEAR(t1.at(14, 9, 12), sum / 8, 1e-3);
  EXPECT_EQ(t1.voxels, sample_t1(phantom, 1).voxels);
  EXPECT_NE(t1.voxels, sample_t1(phantom, 2).voxels);
}

}  // namespace brainshift::pipelines::phantom_test
