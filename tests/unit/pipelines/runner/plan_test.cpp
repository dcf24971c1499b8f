// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/plan.hpp"

#include <gtest/gtest.h>

#include <array>

#include "pipelines/runner/stage_folder.hpp"
#include "tests/unit/pipelines/run_folder.hpp"

namespace brainshift::pipelines::plan_test {

/// The files of a run whose stages before solve are done, and its scene.
class Stamps : public RunFolder {
 protected:
  Stamps() {
    write("run/segment/brain.vtp", "brain");
    write("run/segment/skull.vtp", "skull");
    write("run/segment/labels.nii.gz", "labels");
    write("run/discretise/nodes.vtu", "nodes");
    write("run/discretise/cells.vtu", "cells");
    scene_.image.t1 = write("t1.nii", "t1");
    scene_.image.labels = write("labels.nii", "map");
    scene_.tissues.push_back({1, "parenchyma", "", {}});
    scene_.load.emplace().craniotomy = write("load.csv", "load");
    scene_.source.file = folder_ / "scene.xml";
  }
  std::string stamp_of(StageId stage) {
    InputStates states;
    return stamp(plan_stage(stage, scene_, folder_ / "run", interruption_), states);
  }
  /// Which of the stages segment, discretise, solve, register change their stamps: as "sdvr", "-" where not.
  std::string changed_by(const std::function<void()>& change) {
    const std::array<StageId, 4> stages = {StageId::segment, StageId::discretise, StageId::solve,
                                           StageId::registration};
    std::array<std::string, 4> before;
    for (std::size_t i = 0; i < 4; ++i) {
      before[i] = stamp_of(stages[i]);
    }
    change();
    std::string changed;
    for (std::size_t i = 0; i < 4; ++i) {
      changed += stamp_of(stages[i]) == before[i] ? '-' : "sdvr"[i];
    }
    return changed;
  }

  Scene scene_;
};

TEST_F(Stamps, ChangeForTheStagesThatDependOnAnOptionAlone) {
  EXPECT_EQ(changed_by([] {}), "----");
  EXPECT_EQ(changed_by([&] { scene_.segment.edge_length = 4; }), "s---");
  EXPECT_EQ(changed_by([&] { scene_.discretise.seed = 2; }), "-d--");
  EXPECT_EQ(changed_by([&] { scene_.solve.tolerance = 0.1; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.tissues[0].material.youngs_modulus = 1; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.tissues[0].material.prony.push_back({0.5, 1}); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.loading.gravity.z() = -9.81; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.contact.emplace(); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts.emplace().files.push_back({write("cut.vtp", "cut"), {}}); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts->contact = true; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts->files[0].timing.start = 0.5; }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.resection = solve::Resection{.labels = {1}}; }), "s-v-");
  EXPECT_EQ(changed_by([&] { scene_.resection->pressure = 9; }), "--v-");
  EXPECT_EQ(changed_by([&] { write("run/segment/resection.vtp", "wall"); }), "-dvr");
  scene_.commands[static_cast<std::size_t>(StageId::discretise)] = "another";  // parts no cells
  EXPECT_EQ(changed_by([&] { write("run/segment/resection.vtp", "another wall"); }), "-d-r");
  EXPECT_EQ(changed_by([&] { scene_.registration.fade = 3; }), "---r");
  EXPECT_EQ(changed_by([&] { scene_.tissues.push_back({3, "", "", {}}); }), "sdv-");
}

/// A load that says how well it was measured, by itself or in its file, tells how well it knows the landmarks.
TEST_F(Stamps, OfASolutionChangeWithTheLandmarksOfALoadWithNoise) {
  const std::string head = "# frame: LPS\nx,y,z,ux,uy,uz", row = "\n0,0,20,0,0,-1";
  write("load.csv", head + row + "\n");
  scene_.landmarks = write("landmarks.fcsv", "some");
  EXPECT_EQ(changed_by([&] { write("landmarks.fcsv", "others"); }).substr(0, 3), "---");
  write("load.csv", head + ",sigma" + row + ",0.5\n");
  EXPECT_EQ(changed_by([&] { write("landmarks.fcsv", "once more"); }).substr(0, 3), "--v");
}

/// Which boundaries have nodes follows from the materials.
TEST_F(Stamps, OfNodesAtBoundariesChangeWithThoseThatCount) {
  scene_.tissues = {{1, "", "", {}}, {3, "", "", {}}};
  for (const double factor : {0.6, 1.0}) {
    scene_.discretise.tissue_boundary_factor = factor;
    scene_.tissues[0].material.youngs_modulus = 3000;
    EXPECT_EQ(changed_by([&] { scene_.tissues[0].material.youngs_modulus = 2500; }), "--v-");
    EXPECT_EQ(changed_by([&] { scene_.tissues[0].material.youngs_modulus = 900; }), "-dv-");
  }
}

TEST_F(Stamps, OfNodesChangeWithTheLoadOnlyWhereTheyAreFinerThere) {
  scene_.refinement.factor = 1;
  EXPECT_EQ(changed_by([&] { write("load.csv", "yet another"); }), "--v-");
}

TEST_F(Stamps, ChangeWithTheContentsOfFilesNotTheirNames) {
  EXPECT_EQ(changed_by([&] { write("t1.nii", "another"); }), "s--r");
  EXPECT_EQ(changed_by([&] { write("load.csv", "another"); }), "-dv-");
  EXPECT_EQ(changed_by([&] { write("run/segment/brain.vtp", "another"); }), "-dvr");
  EXPECT_EQ(changed_by([&] { write("run/discretise/nodes.vtu", "another"); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.load->craniotomy = write("moved.csv", "another"); }), "----");
  EXPECT_EQ(changed_by([&] { scene_.loading.curve = write("curve.csv", "one"); }), "--v-");
  EXPECT_EQ(changed_by([&] { write("curve.csv", "two"); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts.emplace().files.push_back({write("cut.vtp", "one"), {}}); }), "--v-");
  EXPECT_EQ(changed_by([&] { write("cut.vtp", "two"); }), "--v-");
  EXPECT_EQ(changed_by([&] { scene_.cuts->files[0].file = write("moved.vtp", "two"); }), "----");
}

TEST_F(Stamps, ACommandCountsWithTheScriptThatItNames) {
  write("mesher.sh", "one");
  EXPECT_EQ(changed_by([&] { scene_.commands[1] = "sh mesher.sh {in} {out}"; }), "-d--");
  EXPECT_EQ(changed_by([&] { write("mesher.sh", "two"); }), "-d--");
}

}  // namespace brainshift::pipelines::plan_test
