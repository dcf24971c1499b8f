// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/segment.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

#include "tests/unit/segmentation/builders.hpp"
#include "tests/unit/segmentation/drawn_head.hpp"

namespace brainshift::test::segment_test {

using namespace drawn_head;
using namespace segmentation;

double dice(const LabelMap& a, const LabelMap& b, std::uint16_t label) {
  double both = 0;
  double sum = 0;
  for (std::size_t i = 0; i < a.voxels.size(); ++i) {
    both += a.voxels[i] == label && b.voxels[i] == label ? 1 : 0;
    sum += (a.voxels[i] == label ? 1 : 0) + (b.voxels[i] == label ? 1 : 0);
  }
  return 2.0 * both / sum;
}

TEST(Segment, AT1WithAMaskGivesTheTissuesThatWereDrawn) {
  const Head drawn = head(oblique_left_handed());
  SegmentInput input;
  input.t1 = drawn.t1;
  input.brain_mask = drawn.mask;
  const Segmentation result = segment(input, two_labels());
  EXPECT_GT(dice(*result.labels, drawn.labels, default_label::parenchyma), 0.99);
  EXPECT_GT(dice(*result.labels, drawn.labels, default_label::ventricles), 0.95);
  ASSERT_EQ(result.memberships.size(), 3U);
  for (std::size_t i = 0; i < drawn.mask.voxels.size(); ++i) {
    const float sum =
        result.memberships[0].voxels[i] + result.memberships[1].voxels[i] + result.memberships[2].voxels[i];
    ASSERT_NEAR(sum, drawn.mask.voxels[i], 1e-5);
  }
}

TEST(Segment, VentriclesThatAT1DoesNotShowAreWarnedOf) {
  Head drawn = head(oblique());
  SegmentInput input;
  input.brain_mask = drawn.mask;
  input.t1 = drawn.t1;
  EXPECT_TRUE(segment(input, two_labels()).notes.empty());
  for (std::size_t i = 0; i < drawn.labels.voxels.size(); ++i) {
    if (drawn.labels.voxels[i] == default_label::ventricles) {
      drawn.t1.voxels[i] += 70;  // as bright as white matter
    }
  }
  input.t1 = drawn.t1;
  const Segmentation result = segment(input, two_labels());
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_NE(result.notes.front().find("warning: only 0 ml of ventricles"), std::string::npos) << result.notes.front();
}

TEST(Segment, ABrainThatTheFieldOfViewCutsOffIsClosedThereAndWarnedOf) {
  const Head drawn = head(oblique());
  SegmentInput input;
  input.labels = ball(drawn.mask.geometry, centre + Eigen::Vector3d(0.0, 0.0, 20.0), brain_radius);
  SegmentOptions options = two_labels();
  options.brain_labels = {1};
  const Segmentation result = segment(input, options);
  EXPECT_TRUE(result.measures.at("brain").closed);
  EXPECT_NEAR(result.measures.at("brain").volume, volume(mask_of(*input.labels)),
              0.01 * volume(mask_of(*input.labels)));
  ASSERT_FALSE(result.notes.empty());
  EXPECT_NE(result.notes.front().find("border cuts the brain off over 2"), std::string::npos) << result.notes.front();
}

TEST(Segment, EverySurfaceIsSoundAndKeepsItsLabelsVolume) {
  const Head drawn = head(oblique());
  SegmentInput input;
  input.labels = drawn.labels;
  SegmentOptions options = two_labels();
  EXPECT_TRUE(segment(input, options).tissues.empty());
  options.tissue_surfaces = true;
  const Segmentation result = segment(input, options);
  EXPECT_EQ(result.tissues.size(), 2U);
  for (const char* name : {"brain", "skull", "tissue_1", "tissue_2"}) {
    const SurfaceMeasures& measures = result.measures.at(name);
    EXPECT_TRUE(measures.closed && measures.outward && !measures.self_intersecting) << name;
    EXPECT_NEAR(measures.volume, measures.label_volume, 0.01 * measures.label_volume) << name;
    EXPECT_LE(measures.boundary_distance_95, 1.0) << name;
  }
  EXPECT_NEAR(result.measures.at("brain").volume, 4.0 / 3.0 * std::numbers::pi * std::pow(brain_radius, 3), 1200.0);
}

TEST(Segment, ATissueThatLiesApartFromTheBrainGetsNoSurface) {
  const Head drawn = head(oblique());
  SegmentInput input;
  input.labels = drawn.labels;
  const LabelMap apart = ball(drawn.mask.geometry, centre + Eigen::Vector3d(0.0, 0.0, brain_radius + 12.0), 4.0);
  for (std::size_t i = 0; i < apart.voxels.size(); ++i) {
    input.labels->voxels[i] = apart.voxels[i] != 0 ? 7 : input.labels->voxels[i];
  }
  SegmentOptions options = two_labels();
  options.brain_labels.push_back(7);
  options.closing = 2;
  options.tissue_surfaces = true;
  const Segmentation result = segment(input, options);
  EXPECT_EQ(result.tissues.size(), 2U);
  EXPECT_TRUE(std::ranges::any_of(result.notes, [](const std::string& note) {
    return note == "label 7 lies apart from the brain: it gets no surface";
  }));
}

TEST(Segment, ATumourMaskJoinsTheBrain) {
  const Head drawn = head(oblique());
  const Eigen::Vector3d place = centre + Eigen::Vector3d(0.0, 28.0, 0.0);
  SegmentInput input;
  input.t1 = drawn.t1;
  input.brain_mask = drawn.mask;
  input.tumour_mask = ball(drawn.mask.geometry, place, 5.0);
  const Segmentation result = segment(input, two_labels());
  EXPECT_EQ(label_at(*result.labels, place), default_label::tumour);
  EXPECT_EQ(label_at(*result.labels, place + Eigen::Vector3d(0.0, 4.0, 0.0)), default_label::tumour);
  EXPECT_GT(result.brain.vertices.col(1).maxCoeff(), place.y() + 4.0);
}

/// As of a map with a table, whose sulci are closed.
TEST(Segment, ALargeHoleThatBecomesTissueIsTold) {
  const Head drawn = head(oblique());
  SegmentOptions options = two_labels();
  options.brain_labels = {1};
  options.closing = 2;
  const auto told = [&](double radius) {
    SegmentInput input;
    input.labels = drawn.mask;
    const LabelMap hole = ball(drawn.mask.geometry, centre, radius);
    for (std::size_t i = 0; i < hole.voxels.size(); ++i) {
      input.labels->voxels[i] = hole.voxels[i] != 0 ? default_label::csf : input.labels->voxels[i];
    }
    return segment(input, options).notes;
  };
  EXPECT_TRUE(told(5).empty()) << "0.5 ml";
  const auto notes = told(10);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(notes.front().starts_with("holes of 4.2 ml in the brain")) << notes.front();
}

TEST(Segment, HolesAreFilledAndLooseBitsLeftOut) {
  Head drawn = head(oblique());
  LabelMap labels = drawn.mask;
  const double whole = static_cast<double>(count(mask_of(labels)));
  const LabelMap hole = ball(labels.geometry, centre, 4.0);
  for (std::size_t i = 0; i < hole.voxels.size(); ++i) {
    labels.voxels[i] = static_cast<std::uint16_t>(hole.voxels[i] != 0 ? 0 : labels.voxels[i]);
  }
  labels.at(3, 3, 3) = 1;
  SegmentInput input;
  input.labels = labels;
  SegmentOptions options = two_labels();
  options.brain_labels = {1};
  const Segmentation result = segment(input, options);
  EXPECT_NEAR(result.measures.at("brain").label_volume, whole, 0.5);
}

TEST(Segment, TheSkullsInnerSurfaceComesFromItsLabel) {
  Head drawn = head(oblique());
  const LabelMap inner = ball(drawn.mask.geometry, centre, 32.0);
  const LabelMap outer = ball(drawn.mask.geometry, centre, 34.0);
  for (std::size_t i = 0; i < inner.voxels.size(); ++i) {
    if (outer.voxels[i] != 0 && inner.voxels[i] == 0) {
      drawn.labels.voxels[i] = default_label::skull;
    }
  }
  SegmentInput input;
  input.labels = drawn.labels;
  SegmentOptions options = two_labels();
  options.skull_label = default_label::skull;
  const Segmentation result = segment(input, options);
  const auto radii = (result.skull.vertices.rowwise() - centre.transpose()).rowwise().norm();
  EXPECT_NEAR(radii.mean(), 32.0, 0.5);
  EXPECT_NEAR((result.brain.vertices.rowwise() - centre.transpose()).rowwise().norm().mean(), brain_radius, 0.5);
}

TEST(Segment, AGivenSurfaceOfAnotherUnitOrWithAStrayVertexIsRefused) {
  Surface metres = tetrahedron(), stray = tetrahedron();
  metres.vertices /= 1000;
  stray.vertices(3, 2) = 1e9;
  for (const Surface& surface : {metres, stray}) {
    SegmentInput input;
    input.surface = surface;
    EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { segment(input, {}); }, {"mm across", "20 to 500 mm"}));
  }
}

TEST(Segment, TheSameInputGivesTheSameSurfaceBitForBit) {
  SegmentInput input;
  input.labels = head(oblique()).labels;
  const Segmentation first = segment(input, two_labels());
  const Segmentation second = segment(input, two_labels());
  EXPECT_EQ(first.brain.vertices, second.brain.vertices);
}

TEST(Segment, WhatClosingTakesInIsParenchymaAndTheFluidBoundsTheSkull) {
  Head drawn = head(oblique());
  const LabelMap outer = ball(drawn.mask.geometry, centre, brain_radius + 3);
  const LabelMap groove = ball(drawn.mask.geometry, centre + Eigen::Vector3d(0.0, brain_radius, 0.0), 2.5);
  for (std::size_t i = 0; i < outer.voxels.size(); ++i) {
    if (outer.voxels[i] != 0 && (drawn.labels.voxels[i] == 0 || groove.voxels[i] != 0)) {
      drawn.labels.voxels[i] = default_label::csf;
    }
  }
  SegmentInput input;
  input.labels = drawn.labels;
  SegmentOptions options = two_labels();
  options.closing = 6;
  options.fluid_label = default_label::csf;
  const Segmentation result = segment(input, options);
  const Eigen::Vector3d in_groove = centre + Eigen::Vector3d(0.0, brain_radius - 1.5, 0.0);
  EXPECT_EQ(label_at(drawn.labels, in_groove), default_label::csf);
  EXPECT_EQ(label_at(*result.labels, in_groove), default_label::parenchyma);
  EXPECT_EQ(label_at(*result.labels, centre), default_label::ventricles);
  EXPECT_GT(result.body->volume, result.body->tissue_volume);
  const auto radii = (result.skull.vertices.rowwise() - centre.transpose()).rowwise().norm();
  EXPECT_NEAR(radii.mean(), brain_radius + 3, 0.5);
}

/// Whatever the numbers are, and in whatever order they are named.
TEST(Segment, WhatClosingTakesInBecomesWhatMostOfTheBrainIs) {
  Head drawn = head(oblique());
  const LabelMap groove = ball(drawn.mask.geometry, centre + Eigen::Vector3d(0.0, brain_radius, 0.0), 2.5);
  for (std::size_t i = 0; i < groove.voxels.size(); ++i) {
    std::uint16_t& label = drawn.labels.voxels[i];
    label = label == default_label::ventricles ? 1 : label == default_label::parenchyma ? 2 : label;
    label = groove.voxels[i] != 0 ? std::uint16_t{0} : label;
  }
  for (const std::vector<std::uint16_t>& order : {std::vector<std::uint16_t>{1, 2}, {2, 1}}) {
    SegmentInput input;
    input.labels = drawn.labels;
    SegmentOptions options = two_labels();
    options.brain_labels = order;
    options.closing = 6;
    const Segmentation result = segment(input, options);
    EXPECT_EQ(label_at(*result.labels, centre + Eigen::Vector3d(0.0, brain_radius - 1.5, 0.0)), 2);
  }
}

TEST(Segment, AHoleOfOtherLabelsInTheBrainIsTold) {
  Head drawn = head(oblique());
  SegmentInput input;
  input.labels = drawn.labels;
  EXPECT_TRUE(segment(input, two_labels()).notes.empty());
  const LabelMap hole = ball(drawn.mask.geometry, centre + Eigen::Vector3d(0.0, 19.0, 0.0), 7.0);
  for (std::size_t i = 0; i < hole.voxels.size(); ++i) {
    input.labels->voxels[i] = hole.voxels[i] != 0 ? std::uint16_t{9} : input.labels->voxels[i];
  }
  const Segmentation result = segment(input, two_labels());
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_NE(result.notes.front().find("holes of 1.4 ml"), std::string::npos) << result.notes.front();
}

TEST(Segment, ASurfaceThatIsWrappedOrRemeshedToAnotherVolumeIsWarnedOf) {
  const Head drawn = head(oblique());
  SegmentInput of_labels;
  of_labels.labels = drawn.labels;
  SegmentInput input;
  input.surface = segment(of_labels, two_labels()).brain;
  SegmentOptions options;
  EXPECT_TRUE(segment(input, options).notes.empty());
  options.edge_length = 10;
  const Segmentation coarse = segment(input, options);
  ASSERT_EQ(coarse.notes.size(), 1U);
  EXPECT_NE(coarse.notes.front().find("warning: the surface was remeshed to edges of 10 mm"), std::string::npos)
      << coarse.notes.front();
  options.edge_length = 5;
  const Surface whole = *input.surface;
  input.surface->triangles.conservativeResize(whole.triangles.rows() - 1, 3);
  const Segmentation closed = segment(input, options);
  ASSERT_EQ(closed.notes.size(), 1U);
  EXPECT_EQ(closed.notes.front(), "the surface had holes, 1 of them, which were closed with triangles");
  input.surface = without_top(whole, 0.05);
  const Segmentation wrapped = segment(input, options);
  ASSERT_EQ(wrapped.notes.size(), 1U);
  EXPECT_NE(wrapped.notes.front().find("is open or cuts itself and was wrapped; it holds"), std::string::npos)
      << wrapped.notes.front();
  input.surface->vertices.col(2).array() += 5000;
  EXPECT_EQ(segment(input, options).notes, wrapped.notes) << "wherever it lies";
}

TEST(Segment, WithoutFluidTheLabelsAroundTheBrainBoundTheSkullWhereTheyCan) {
  for (const auto& [gap, radius, said] : {std::tuple(3.0, brain_radius + 3, "reach to the labels around"),
                                          {20.0, brain_radius, "own surface is taken"}}) {
    Head drawn = head(oblique());
    const LabelMap inner = ball(drawn.mask.geometry, centre, brain_radius + gap);
    for (std::size_t i = 0; i < inner.voxels.size(); ++i) {
      drawn.labels.voxels[i] = inner.voxels[i] == 0 ? default_label::skin : drawn.labels.voxels[i];
    }
    SegmentInput input;
    input.labels = drawn.labels;
    SegmentOptions options = two_labels();
    options.fluid_label = default_label::csf;
    const Segmentation result = segment(input, options);
    const auto radii = (result.skull.vertices.rowwise() - centre.transpose()).rowwise().norm();
    EXPECT_NEAR(radii.mean(), radius, 0.5);
    ASSERT_FALSE(result.notes.empty());
    EXPECT_NE(result.notes.back().find(said), std::string::npos) << result.notes.back();
  }
}

TEST(Segment, ALargeLoosePieceIsNamed) {
  Head drawn = head(oblique());
  const LabelMap piece = ball(drawn.mask.geometry, drawn.mask.geometry.to_world({8, 8, 8}), 7);
  for (std::size_t i = 0; i < piece.voxels.size(); ++i) {
    drawn.labels.voxels[i] = std::max(drawn.labels.voxels[i], piece.voxels[i]);
  }
  SegmentInput input;
  input.labels = drawn.labels;
  const Segmentation result = segment(input, two_labels());
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_NE(result.notes.front().find("dropped 1.4 ml of tissue ("), std::string::npos) << result.notes.front();
}

}  // namespace brainshift::test::segment_test
