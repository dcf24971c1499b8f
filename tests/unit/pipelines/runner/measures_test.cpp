// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/measures.hpp"

#include <gtest/gtest.h>

namespace brainshift::pipelines::measures_test {

using nlohmann::ordered_json;
using solve::Dynamics;

TEST(StageMeasures, OfTheSegmentationNameEachSurface) {
  segmentation::Segmentation result;
  EXPECT_EQ(report_of(result).sizes, (ordered_json{{"surfaces", 0}})) << "no voxels where there is no image";
  result.labels = LabelMap{.geometry = {.size = {2, 3, 4}}, .voxels = {}};
  result.measures["brain"] = {.vertices = 1,
                              .triangles = 2,
                              .volume = 3,
                              .label_volume = 4,
                              .boundary_distance_95 = 5,
                              .edge_length_mean = 6,
                              .edge_length_target = 7,
                              .closed = true,
                              .outward = false,
                              .self_intersecting = false,
                              .repaired = true,
                              .within_bounds = true};
  result.body = segmentation::BodyMeasures{.tissue_volume = 1, .volume = 2, .loose_volume = 3, .loose_pieces = 4};
  result.notes = {"a sentence"};
  const StageReport report = report_of(result);
  EXPECT_EQ(report.notes, result.notes);
  EXPECT_EQ(report.sizes, (ordered_json{{"surfaces", 1}, {"voxels", 24}}));
  EXPECT_EQ(report.measures, ordered_json::parse(R"({"brain": {"vertices": 1, "triangles": 2, "volume_mm3": 3.0,
    "label_volume_mm3": 4.0, "boundary_distance_95_mm": 5.0, "edge_length_mean_mm": 6.0, "edge_length_target_mm": 7.0,
    "closed": true, "outward": false, "self_intersecting": false, "repaired": true, "within_bounds": true},
    "body": {"tissue_volume_mm3": 1.0, "volume_mm3": 2.0, "loose_volume_mm3": 3.0, "loose_pieces": 4}})"));
  EXPECT_TRUE(report.failure.empty());
}

TEST(StageMeasures, OfTheDiscretisationAreItsNumbers) {
  const StageReport report = report_of(discretise::DiscretiseMeasures{.nodes = 1,
                                                                      .surface_nodes = 2,
                                                                      .boundary_nodes = 13,
                                                                      .removed_nodes = 3,
                                                                      .cells = 4,
                                                                      .cut_cells = 5,
                                                                      .dropped_cells = 6,
                                                                      .dropped_volume = 7,
                                                                      .spacing = 8,
                                                                      .mean_spacing = 9,
                                                                      .smallest_distance_ratio = 10,
                                                                      .surface_volume = 11,
                                                                      .cells_inside_volume = 12});
  EXPECT_EQ(report.sizes, ordered_json::parse(R"({"nodes": 1, "surface_nodes": 2, "boundary_nodes": 13,
    "cells": 4, "cut_cells": 5, "removed_nodes": 3, "dropped_cells": 6})"));
  EXPECT_EQ(report.measures, ordered_json::parse(R"({"spacing_mm": 8.0, "mean_spacing_mm": 9.0,
    "smallest_distance_ratio": 10.0, "surface_volume_mm3": 11.0, "cells_inside_volume_mm3": 12.0})"));
}

TEST(StageMeasures, OfASolutionHoldTheBoundOfARelaxationOrTheStepOfAMotion) {
  solve::SolveResult result;
  result.failure = "it did not converge";
  result.measures.steps = 70;
  result.measures.error_bound = 0.25;
  result.measures.critical_step = 1e-4;
  const StageReport steady = report_of(result, Dynamics::relaxation);
  EXPECT_EQ(steady.failure, "it did not converge");
  EXPECT_EQ(steady.sizes["steps"], 70);
  EXPECT_EQ(steady.measures["error_bound_mm"], 0.25);
  EXPECT_FALSE(steady.measures.contains("critical_step_s"));
  const StageReport motion = report_of(result, Dynamics::transient);
  EXPECT_EQ(motion.measures["critical_step_s"], 1e-4);
  EXPECT_FALSE(motion.measures.contains("error_bound_mm"));
}

TEST(StageMeasures, OfASolutionLeaveOutWhatWasNotAskedFor) {
  solve::SolveResult result;
  result.measures.nodes = 400;
  for (const char* const part : {"region", "seconds_coarse", "cut", "resection"}) {
    EXPECT_FALSE(report_of(result, Dynamics::relaxation).measures.contains(part)) << part;
  }
  result.measures.region_nodes = 100;
  result.measures.coarse_error = 0.5;
  result.measures.seconds_coarse = 2;
  result.measures.resection = solve::ResectionMeasures{.removed_nodes = 3, .removed_volume = 4};
  result.measures.cut.emplace().split_nodes = 5;
  const ordered_json measures = report_of(result, Dynamics::relaxation).measures;
  EXPECT_EQ(measures["region"], ordered_json::parse(R"({"nodes": 100, "share": 0.25, "coarse_error_mm": 0.5})"));
  EXPECT_EQ(measures["seconds_coarse"], 2.0);
  EXPECT_EQ(measures["resection"], ordered_json::parse(R"({"removed_nodes": 3, "removed_volume_mm3": 4.0})"));
  EXPECT_EQ(measures["cut"]["split_nodes"], 5);
  EXPECT_FALSE(measures["cut"].contains("touching_nodes"));
  result.measures.cut->faces = solve::FaceMeasures{.touching_nodes = 6, .largest_overlap = 0.125};
  const ordered_json touching = report_of(result, Dynamics::relaxation).measures;
  EXPECT_EQ(touching["cut"]["touching_nodes"], 6);
  EXPECT_EQ(touching["cut"]["largest_overlap_mm"], 0.125);
}

TEST(StageMeasures, OfARegistrationCountItsVoxelsAndLandmarks) {
  registration::Registration result;
  result.forward.geometry.size = {2, 3, 4};
  result.landmarks = Points::Zero(5, 3);
  result.measures.brain_voxels = 6;
  result.measures.moved_voxels = 7;
  result.measures.inverse_mean = 0.125;
  result.measures.inverse_999 = 0.375;
  result.measures.inverse_max = 0.625;
  result.measures.not_inverted = 9;
  result.measures.jacobian_min = 0.5;
  result.measures.jacobian_max = 1.5;
  result.measures.field_jacobian_min = 0.25;
  result.measures.folded_voxels = 8;
  result.measures.largest_displacement = 10.5;
  result.measures.fit_error = 1.25;
  result.measures.without_nodes = 54;
  result.measures.seconds = 3.5;
  const StageReport report = report_of(result);
  EXPECT_EQ(report.sizes,
            ordered_json::parse(R"({"voxels": 24, "brain_voxels": 6, "moved_voxels": 7, "landmarks": 5})"));
  EXPECT_EQ(report.measures, ordered_json::parse(R"({"inverse_mean_mm": 0.125, "inverse_999_mm": 0.375,
    "inverse_max_mm": 0.625, "not_inverted": 9, "jacobian_min": 0.5, "jacobian_max": 1.5, "field_jacobian_min": 0.25,
    "folded_voxels": 8, "largest_displacement_mm": 10.5, "fit_error_mm": 1.25, "voxels_without_nodes": 54,
    "seconds_fields_and_images": 3.5})"));
}

}  // namespace brainshift::pipelines::measures_test
