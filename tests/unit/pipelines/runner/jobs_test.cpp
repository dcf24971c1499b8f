// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/jobs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/markup_texts.hpp"
#include "tests/unit/pipelines/ball_folder.hpp"

namespace brainshift::pipelines::jobs_test {

using brainshift::test::expect_parts;
using brainshift::test::mrk_json;
using brainshift::test::refusal;

class JobsTest : public BallFolder {
 protected:
  Load measured() const {
    Load load;
    load.craniotomy = folder_ / "load.csv";
    return load;
  }
  /// The ball's nodes and cells in the folder, and the job that solves them.
  SolveJob solve_job() const {
    DiscretiseJob cells;
    cells.surface = folder_ / "ball.vtp";
    cells.options.nodes = 60;
    run_job(cells, folder_, {});
    SolveJob job{.nodes = folder_ / "nodes.vtu",
                 .cells = folder_ / "cells.vtu",
                 .labels = {},
                 .skull = {},
                 .surface = folder_ / "ball.vtp",
                 .load = measured(),
                 .materials = {{1, solve::Material{}}},
                 .options = {},
                 .loading = {}};
    job.options.shape.basis = Basis::linear;
    job.options.points_per_cell = 1;
    job.options.tolerance = 0.1;
    return job;
  }
  /// An image over the ball, 2.5 mm a voxel; shift: of its place, mm.
  ScalarImage image(double shift = 0) const {
    ScalarImage t1;
    t1.geometry.size = {20, 20, 20};
    t1.geometry.spacing.setConstant(2.5);
    t1.geometry.origin.setConstant(-23.75 + shift);
    for (std::size_t voxel = 0; voxel < t1.geometry.voxel_count(); ++voxel) {
      t1.voxels.push_back(static_cast<float>(voxel % 7));
    }
    return t1;
  }
  /// Labels on that image: a block so many voxels within its border, and what is about it.
  LabelMap block(int border, std::uint16_t inside, std::uint16_t outside) const {
    LabelMap labels{image().geometry, std::vector<std::uint16_t>(image().voxels.size(), outside)};
    for (int k = border; k < 20 - border; ++k) {
      for (int j = border; j < 20 - border; ++j) {
        for (int i = border; i < 20 - border; ++i) {
          labels.at(i, j, k) = inside;
        }
      }
    }
    return labels;
  }
  /// A field on that image that moves all alike, as a load without an opening.
  Load field(double shift) const {
    VectorImage alike{image(shift).geometry, {}};
    alike.voxels.assign(alike.geometry.voxel_count(), {0.5F, 0, -1});
    write_image(folder_ / "alike.mha", alike);
    Load load;
    load.field = {.file = folder_ / "alike.mha", .where = {}, .moves = FieldLoad::Moves::points};
    return load;
  }
};

TEST_F(JobsTest, ALoadIsReadFromWhereItIsMeasured) {
  EXPECT_EQ(read_load(measured(), {}).displacement.row(3), Eigen::RowVector3d(0, 0, -1));
  Load markups;
  markups.markups = {write("before.mrk.json", mrk_json("\"LPS\"", {{"a", "1, 2, 3"}})),
                     write("after.mrk.json", mrk_json("\"LPS\"", {{"a", "1, 2, 5"}}))};
  EXPECT_EQ(read_load(markups, {}).displacement, Eigen::RowVector3d(0, 0, 2));
  Load surfaces;
  surfaces.surfaces = {folder_ / "ball.vtp", folder_ / "ball.vtp"};
  EXPECT_NEAR(read_load(surfaces, {}).displacement.norm(), 0, 1e-6);
  Surface sunk = read_surface(folder_ / "ball.vtp");
  sunk.vertices.col(2).array() -= 2;
  write_surface(folder_ / "sunk.vtp", sunk);
  surfaces.surfaces = {folder_ / "ball.vtp", folder_ / "sunk.vtp"};
  EXPECT_LT(read_load(surfaces, {}).displacement.col(2).mean(), -0.5) << "from before to after";
  Load simulated;
  simulated.simulated = solve::SimulatedCraniotomy{.centre = {0, 0, 20}, .radius = 12, .depth = 3};
  EXPECT_NEAR(read_load(simulated, folder_ / "ball.vtp").displacement.rowwise().norm().maxCoeff(), 3, 0.3);
  expect_parts(refusal([] { read_load({}, {}); }), {"no load is named"});
}

TEST_F(JobsTest, ASegmentationTakesLabelsOfAnyGridToTheImages) {
  LabelMap labels = block(4, 1, 0);
  ScalarImage t1 = image();
  std::fill(t1.voxels.begin(), t1.voxels.end(), 1.0F);
  write_image(folder_ / "t1.nii.gz", t1);
  write_image(folder_ / "labels.nii.gz", labels);
  SegmentJob job;
  job.image.labels = folder_ / "labels.nii.gz";
  job.image.t1 = folder_ / "t1.nii.gz";
  job.options.brain_labels = {1};
  const StageReport report = run_job(job, folder_ / "out", {});
  EXPECT_EQ(report.sizes["voxels"], 8000);
  EXPECT_TRUE(report.notes.empty());
  EXPECT_TRUE(fs::exists(folder_ / "out/brain.vtp"));

  const double step = labels.geometry.spacing.x();
  labels.geometry.origin.x() += step;
  write_image(folder_ / "labels.nii.gz", labels);
  const StageReport moved = run_job(job, folder_ / "out", {});
  ASSERT_EQ(moved.notes.size(), 1U);
  expect_parts(moved.notes.front(), {"labels.nii.gz", "another grid than", "t1.nii.gz"});
  const LabelMap taken = read_label_map(folder_ / "out/labels.nii.gz");
  EXPECT_TRUE(same_geometry(taken.geometry, image().geometry));
  EXPECT_EQ(taken.at(16, 10, 10), 1);
  EXPECT_EQ(taken.at(4, 10, 10), 0);

  labels.geometry.origin.x() += 11 * step;
  write_image(folder_ / "labels.nii.gz", labels);
  expect_parts(refusal([&] { run_job(job, folder_ / "out", {}); }),
               {"labels.nii.gz: 33 % of it lie within", "t1.nii.gz", "20 x 20 x 20 voxels", "one patient"});
}

TEST_F(JobsTest, AMapOrMaskWhoseOwnBorderCutsTheBrainOffWithinTheT1IsWarnedOf) {
  write_image(folder_ / "t1.nii.gz", image());
  SegmentJob job;
  job.image.t1 = folder_ / "t1.nii.gz";
  job.options.brain_labels = {1};
  LabelMap map = block(4, 1, 0);
  const auto warned = [&](fs::path ImageInputs::*as) {
    job.image.labels.clear();
    job.image.brain_mask.clear();
    job.image.*as = folder_ / "map.nii.gz";
    write_image(folder_ / "map.nii.gz", map);
    const auto notes = run_job(job, folder_ / "out", {}).notes;
    return std::ranges::count_if(notes, [](const std::string& note) {
      return note.starts_with("warning: the border of ") && note.find("map.nii.gz") != std::string::npos &&
             note.find("cuts the brain off over 9.0 cm2") != std::string::npos;
    });
  };
  EXPECT_EQ(warned(&ImageInputs::labels), 0);
  map.geometry.size.z() = 14;  // the block ends at 16
  map.voxels.resize(map.geometry.voxel_count());
  EXPECT_EQ(warned(&ImageInputs::labels), 1);
  EXPECT_EQ(warned(&ImageInputs::brain_mask), 1);
  ScalarImage short_t1{map.geometry, std::vector<float>(map.voxels.size(), 1)};
  short_t1.geometry.size.x() = 19;
  short_t1.voxels.resize(short_t1.geometry.voxel_count());
  write_image(job.image.t1, short_t1);
  EXPECT_EQ(warned(&ImageInputs::labels), 0) << "it is the T1's border, which is told of as such";
}

TEST_F(JobsTest, AMaskMayBeAnImageAndATumourAMapOfBrats) {
  LabelMap tumour{image().geometry, std::vector<std::uint16_t>(image().voxels.size(), 0)};
  ScalarImage stripped{image().geometry, std::vector<float>(image().voxels.size(), 0)};
  for (int k = 3; k < 17; ++k) {
    for (int j = 3; j < 17; ++j) {
      for (int i = 3; i < 17; ++i) {
        stripped.at(i, j, k) = 0.5F + static_cast<float>(i % 3);
        tumour.at(i, j, k) = i < 8 ? std::uint16_t{4} : i < 12 ? std::uint16_t{2} : std::uint16_t{0};
      }
    }
  }
  write_image(folder_ / "t1.nii.gz", stripped);
  write_image(folder_ / "tumour.nii.gz", tumour);
  SegmentJob job;
  job.image.t1 = job.image.brain_mask = folder_ / "t1.nii.gz";
  job.image.tumour = folder_ / "tumour.nii.gz";
  const StageReport said = run_job(job, folder_ / "out", {});
  EXPECT_TRUE(std::ranges::any_of(said.notes, [](const std::string& note) {
    return note.find("tumour.nii.gz: taken for BraTS's numbers, so that 2 (12.3 ml) is oedema") != std::string::npos;
  }));
  const LabelMap labels = read_label_map(folder_ / "out/labels.nii.gz");
  EXPECT_EQ(labels.at(6, 10, 10), 3);
  EXPECT_NE(labels.at(10, 10, 10), 3);
  EXPECT_EQ(labels.at(1, 1, 1), 0);
}

TEST_F(JobsTest, AMaskOfProbabilitiesIsRefusedAndNotAnImageScaledToOne) {
  const LabelMap inside = block(3, 1, 0);
  ScalarImage mask = image();
  const auto read = [&](const std::function<float(std::size_t)>& in_brain) {
    for (std::size_t i = 0; i < mask.voxels.size(); ++i) {
      mask.voxels[i] = inside.voxels[i] == 0 ? 0.0F : in_brain(i);
    }
    write_image(folder_ / "mask.nii.gz", mask);
    return refusal([&] { read_mask(folder_ / "mask.nii.gz"); });
  };
  EXPECT_EQ(read([](std::size_t) { return 1.0F; }), "");
  EXPECT_EQ(read([](std::size_t i) { return 0.2F + 0.1F * static_cast<float>(i % 9); }), "") << "a stripped T1";
  EXPECT_EQ(read([](std::size_t i) { return i % 3 == 0 ? 7.5F : 0.01F; }), "") << "a stripped T1 with a dark rim";
  for (const auto& fractions : {std::function([](std::size_t i) { return i % 5 == 0 ? 0.5F : 1.0F; }),
                                std::function([](std::size_t i) { return i % 5 == 0 ? 0.4F : 1e-6F; })}) {
    expect_parts(read(fractions), {"mask.nii.gz", "probabilities", "above a half"});
  }
}

/// The tumour of a file gets the number 3, which a map may use for another tissue.
TEST_F(JobsTest, ATumourOfItsOwnFileBesideItsNumberInTheMapIsWarnedOf) {
  LabelMap labels = block(4, 1, 0), tumour = block(8, 1, 0);
  SegmentJob job;
  job.image.labels = folder_ / "labels.nii.gz";
  job.image.tumour = folder_ / "tumour.nii.gz";
  job.options.brain_labels = {1, 3};
  write_image(job.image.tumour, tumour);
  const auto notes = [&] {
    write_image(job.image.labels, labels);
    return run_job(job, folder_ / "out", {}).notes;
  };
  EXPECT_TRUE(notes().empty());
  labels.at(5, 5, 5) = 3;
  EXPECT_TRUE(notes().empty()) << "as another hand may have drawn it";
  for (int i = 4; i < 16; ++i) {
    for (int j = 4; j < 8; ++j) {
      labels.at(i, j, 5) = 3;
    }
  }
  const std::vector<std::string> said = notes();
  ASSERT_EQ(said.size(), 1U);
  expect_parts(said.front(), {"warning: label 3 of", "labels.nii.gz", "0.8 ml", "of 1 ml", "another number"});
  write_image(job.image.tumour, block(4, 0, 0));
  expect_parts(notes().front(), {"warning:", "tumour.nii.gz", "no voxel is tumour"});
}

TEST_F(JobsTest, ADiscretisationIsFinerWhereTheLoadIs) {
  DiscretiseJob job;
  job.surface = folder_ / "ball.vtp";
  job.options.nodes = 200;
  job.load = measured();
  job.refinement = {.centres = {}, .radius = 8, .factor = 0.4};
  const auto near_the_top = [&] {
    run_job(job, folder_, {});
    return (read_node_cloud(folder_ / "nodes.vtu").positions.col(2).array() > 12).count();
  };
  const auto refined = near_the_top();
  job.refinement.factor = 1;
  EXPECT_GT(refined, 1.5 * static_cast<double>(near_the_top()));
}

TEST_F(JobsTest, ADiscretisationIsNoFinerForAFieldWithoutAnOpening) {
  DiscretiseJob job;
  job.surface = folder_ / "ball.vtp";
  job.options.nodes = 200;
  job.refinement = {.centres = {}, .radius = 8, .factor = 0.4};
  run_job(job, folder_, {});
  const Points without = read_node_cloud(folder_ / "nodes.vtu").positions;
  job.load = field(0);
  run_job(job, folder_, {});
  const Points with = read_node_cloud(folder_ / "nodes.vtu").positions;
  ASSERT_EQ(with.rows(), without.rows());
  EXPECT_EQ(with, without);
}

TEST_F(JobsTest, AFieldWithoutAnOpeningActsAtTheSurfaceNodesInItsGridAlone) {
  SolveJob job = solve_job();
  job.load = field(20);  // from -5 mm on along each axis
  const SolveInput input = read_input(job);
  const NodeCloud& cloud = input.model.cloud;
  Eigen::Index in_grid = 0;
  for (const std::int32_t node : surface_nodes(cloud)) {
    in_grid += (cloud.positions.row(node).array() >= -5).all() ? 1 : 0;
  }
  ASSERT_GT(in_grid, 0);
  ASSERT_LT(in_grid, static_cast<Eigen::Index>(surface_nodes(cloud).size()));
  for (Eigen::Index node = 0; node < cloud.positions.rows(); ++node) {
    const bool on_surface = cloud.on_surface[static_cast<std::size_t>(node)] != 0;
    const bool acts = on_surface && (cloud.positions.row(node).array() >= -5).all();
    const Eigen::RowVector3d prescribed = input.model.conditions.displacement.row(node);
    EXPECT_TRUE(acts ? (prescribed - Eigen::RowVector3d(0.5, 0, -1)).norm() < 1e-12 : prescribed.array().isNaN().all())
        << cloud.positions.row(node);
  }
  EXPECT_EQ(input.load->positions.rows(), in_grid);
}

TEST_F(JobsTest, AFieldThatIsDefinedNowhereOnTheSurfaceIsRefused) {
  SolveJob job = solve_job();
  job.load = field(1000);
  expect_parts(refusal([&] { read_input(job); }), {"alike.mha: it says nothing of the", "outside its grid"});
}

TEST_F(JobsTest, WhatASolveJobNamesIsInItsModel) {
  SolveJob job = solve_job();
  job.loading = {.duration = 2, .curve = {}, .gravity = {0, 0, -9.81}};
  job.skull = folder_ / "ball.vtp";
  job.resection = solve::Resection{{3}, 20};
  const SolveInput input = read_input(job);
  EXPECT_EQ(input.model.gravity, Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(input.model.curve.duration(), 2);
  EXPECT_EQ(input.model.skull->triangles.rows(), read_surface(folder_ / "ball.vtp").triangles.rows());
  EXPECT_EQ(input.model.resection->labels, std::vector<std::int32_t>{3});
  EXPECT_EQ(input.model.materials.size(), 1U);
  EXPECT_FALSE(input.model.labels);
  EXPECT_EQ(input.options.tolerance, 0.1);
  const Points& prescribed = input.model.conditions.displacement;
  for (Eigen::Index node = 0; node < prescribed.rows(); ++node) {
    EXPECT_TRUE(std::isnan(prescribed(node, 2)) || input.model.cloud.positions(node, 2) > 10);
  }
  EXPECT_TRUE((prescribed.col(2).array() == -1).any());
}

TEST_F(JobsTest, ANumberOfTheMapThatHasNoMaterialIsRefusedWhereTheOthersAreKnown) {
  write_image(folder_ / "labels.nii.gz", block(6, 17, 1));
  SolveJob job = solve_job();
  job.labels = folder_ / "labels.nii.gz";
  EXPECT_NO_THROW(read_input(job)) << "of a stage alone nobody knows the others";
  job.other_labels = {4, 5};
  expect_parts(refusal([&] { read_input(job); }), {"labels.nii.gz: label 17", "no material", "other_labels"});
  job.other_labels = {4, 17};
  EXPECT_NO_THROW(read_input(job));
}

TEST_F(JobsTest, MarkupsThatWerePairedByTheirOrderSaySo) {
  const auto list = [](const std::string& label, const std::string& z) {
    return mrk_json("\"LPS\"", {{label + "1", "0, 0, " + z}, {label + "2", "5, 0, " + z}, {label + "3", "0, 5, " + z}});
  };
  SolveJob job = solve_job();
  job.load.emplace().markups = {write("before.mrk.json", list("a", "20")), write("after.mrk.json", list("A", "19"))};
  EXPECT_EQ(read_input(job).notes, std::vector<std::string>());
  write("after.mrk.json", list("b", "19"));
  const std::vector<std::string> notes = read_input(job).notes;
  ASSERT_EQ(notes.size(), 1U);
  expect_parts(notes.front(), {"before.mrk.json and ", "share no label", "by their order"});
}

TEST_F(JobsTest, WithoutALoadTheNodesPrescribeTheirOwn) {
  SolveJob job = solve_job();
  NodeCloud cloud = read_node_cloud(job.nodes);
  solve::Conditions conditions;
  conditions.displacement = Points::Constant(cloud.positions.rows(), 3, std::nan(""));
  conditions.displacement.row(5).setConstant(0.25);
  solve::write_nodes(folder_ / "own.vtu", cloud, conditions);
  job.nodes = folder_ / "own.vtu";
  job.load.reset();
  const SolveInput input = read_input(job);
  EXPECT_EQ(input.model.conditions.displacement.row(5), Eigen::RowVector3d(0.25, 0.25, 0.25));
  EXPECT_FALSE(input.load);
}

TEST_F(JobsTest, TheForcesOfTheNodesFileActBesideALoad) {
  SolveJob job = solve_job();
  const NodeCloud cloud = read_node_cloud(job.nodes);
  solve::Conditions conditions;
  conditions.force = Points::Zero(cloud.positions.rows(), 3);
  conditions.force(5, 2) = 1e-3;
  job.nodes = folder_ / "own.vtu";
  solve::write_nodes(job.nodes, cloud, conditions);
  const auto expect_forces = [&] {
    const Points force = read_input(job).model.conditions.force;
    ASSERT_EQ(force.rows(), conditions.force.rows());
    EXPECT_EQ(force, conditions.force);
  };
  expect_forces();
  job.load = field(0);
  job.load->noise = 0.5;
  expect_forces();
}

TEST_F(JobsTest, ASolveWritesTheLoadBesideTheSolution) {
  const StageReport report = run_job(solve_job(), folder_ / ".", {});
  EXPECT_EQ(report.failure, "");
  EXPECT_EQ(report.sizes["nodes"], read_node_cloud(folder_ / "nodes.vtu").size());
  EXPECT_EQ(read(folder_ / "load.csv").find("# frame: LPS"), 0U);
  EXPECT_TRUE(fs::exists(folder_ / "solution.vtu"));
}

TEST_F(JobsTest, ARegistrationWarpsMoreFilesButNoTwoOfOneName) {
  run_job(solve_job(), folder_, {});
  write_image(folder_ / "t1.nii.gz", image());
  fs::create_directories(folder_ / "other");
  fs::create_directories(folder_ / "out");
  write_image(folder_ / "flair.nii.gz", image());
  write_image(folder_ / "other/flair.nii.gz", image());
  RegisterJob job{.solution = folder_ / "solution.vtu",
                  .surface = folder_ / "ball.vtp",
                  .t1 = folder_ / "t1.nii.gz",
                  .labels = {},
                  .landmarks = {},
                  .warp = {folder_ / "flair.nii.gz", folder_ / "other/flair.nii.gz"},
                  .warp_labels = {},
                  .options = {}};
  expect_parts(refusal([&] { run_job(job, folder_ / "out", {}); }),
               {"other/flair.nii.gz: there is a warped_flair.nii.gz already", "rename"});
  EXPECT_TRUE(fs::is_empty(folder_ / "out"));
  job.warp.pop_back();
  job.warp_labels = {folder_ / "mistyped.nii.gz"};
  expect_parts(refusal([&] { run_job(job, folder_ / "out", {}); }), {"mistyped.nii.gz: no such file"});
  EXPECT_TRUE(fs::is_empty(folder_ / "out")) << "what is missing is said before anything is computed";
}

}  // namespace brainshift::pipelines::jobs_test
