// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the tests of bad input share: a ball with everything that a run of it needs, and a box and a rectangle to solve.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "discretise/interface/background_cells.hpp"
#include "discretise/interface/node_cloud.hpp"
#include "segmentation/image/image.hpp"
#include "tests/phantoms/program.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::bad_input {

inline constexpr int grid = 28;
inline constexpr double voxel = 4.0;
inline constexpr double ball_radius = 40.0;

/// A ball of label 1 in the middle of the grid, or moved by some voxels along x.
inline LabelMap ball_labels(int moved = 0) {
  LabelMap map;
  map.geometry.size = {grid, grid, grid};
  map.geometry.spacing = Eigen::Vector3d::Constant(voxel);
  map.voxels.assign(map.geometry.voxel_count(), 0);
  const Eigen::Vector3d centre(grid / 2.0 + moved, grid / 2.0, grid / 2.0);
  for (int k = 0; k < grid; ++k) {
    for (int j = 0; j < grid; ++j) {
      for (int i = 0; i < grid; ++i) {
        map.at(i, j, k) = (Eigen::Vector3d(i, j, k) - centre).norm() * voxel < ball_radius ? 1 : 0;
      }
    }
  }
  return map;
}

inline ScalarImage ball_t1() {
  const LabelMap labels = ball_labels();
  ScalarImage image{labels.geometry, std::vector<float>(labels.voxels.begin(), labels.voxels.end())};
  return image;
}

/// A ball in a folder with everything that a run of it needs, made once.
class BadInput : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch = std::make_unique<ScratchFolder>();
    write_image(at("labels.nii.gz"), ball_labels());
    write_image(at("t1.nii.gz"), ball_t1());
    write_load("load.csv", "LPS", 0);
    write_scene("scene.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>");
    const ProgramResult made = run_shell(
        "set -e\nbrainshift segment --brain-labels 1 --edge-length 12 --labels " + at("labels.nii.gz") + " --out " +
        at("ball") + "\nbrainshift discretise --nodes 250 --surface " + at("ball/brain.vtp") + " --out " + at("ball"));
    ASSERT_EQ(made.code, 0) << made.err;
  }
  static void TearDownTestSuite() { scratch.reset(); }

  static std::string at(const std::string& name) { return (*scratch / name).string(); }

  /// Three points at the top of the ball, or beyond it, pushed inward; written in the frame that is named, without
  /// conversion.
  static void write_load(const std::string& name, const std::string& frame, double beyond,
                         const std::string& last_line = "") {
    const double c = grid / 2 * voxel;
    std::string text = "# frame: " + frame + "\nx,y,z,ux,uy,uz\n";
    for (const auto& [x, y] : {std::pair(-6.0, 0.0), std::pair(6.0, -6.0), std::pair(6.0, 6.0)}) {
      text += std::to_string(c + x) + "," + std::to_string(c + y) + "," + std::to_string(c + ball_radius + beyond) +
              ",0,0,-2\n";
    }
    write_text(at(name), text + last_line);
  }
  static void write_scene(const std::string& name, const std::string& t1, const std::string& labels,
                          const std::string& load, const std::string& tissue = "<tissue label=\"1\"/>") {
    write_text(at(name), "<scene>\n<image t1=\"" + t1 + "\" labels=\"" + labels + "\"/>\n<tissues>" + tissue +
                             "</tissues>\n<load>" + load +
                             "</load>\n<contact/>\n<stage name=\"segment\" edge_length=\"12\"/>\n"
                             "<stage name=\"discretise\" nodes=\"250\"/>\n<stage name=\"solve\" basis=\"linear\" "
                             "points_per_cell=\"1\" tolerance=\"0.1\"/>\n</scene>\n");
  }
  static std::string run_scene(const std::string& scene) {
    return "brainshift run --quiet " + at(scene) + " --out " + at("out");
  }
  static std::string solve_ball(const std::string& more) {
    return "brainshift solve --quiet --nodes " + at("ball/nodes.vtu") + " --cells " + at("ball/cells.vtu") +
           " --material 1:3000,0.45 --skull " + at("ball/skull.vtp") + " --out " + at("out") + " " + more;
  }

  /// Solves a box whose bottom is held, or what `change` makes of it.
  static std::string solve_box(const std::string& more, const std::function<void(NodeCloud&)>& change = {}) {
    NodeCloud cloud = test::irregular_box(4, 30);
    solve::Conditions conditions = test::all_free(cloud);
    for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
      if (cloud.positions(a, 2) < 1e-6) {
        conditions.displacement.row(a).setZero();
      }
    }
    if (change) {
      change(cloud);
    }
    solve::write_nodes(at("box_nodes.vtu"), cloud, conditions);
    write_background_cells(at("box_cells.vtu"), test::box_cells(3, 30));
    return "brainshift solve --quiet --nodes " + at("box_nodes.vtu") + " --cells " + at("box_cells.vtu") + " --out " +
           at("out") + " " + more;
  }

  /// Solves a rectangle that two of its nodes hold.
  static std::string solve_flat(const std::string& more) {
    const NodeCloud cloud = test::irregular_rectangle(6, 4, 50, 30);
    solve::Conditions conditions = test::all_free(cloud);
    conditions.displacement.topRows<2>().setZero();
    solve::write_nodes(at("flat_nodes.vtu"), cloud, conditions);
    write_background_cells(at("flat_cells.vtu"), test::rectangle_cells(5, 3, 50, 30));
    return "brainshift solve --quiet --nodes " + at("flat_nodes.vtu") + " --cells " + at("flat_cells.vtu") + " --out " +
           at("out") + " " + more;
  }

  /// One sentence on standard error that holds the parts, the exit code, and nothing in `out` but finished stages.
  static void expect_refused(const std::string& command, const std::vector<std::string>& parts, int code = 2) {
    SCOPED_TRACE(command);
    std::filesystem::remove_all(at("out"));
    ProgramResult result = run_shell(command);
    // The NIfTI library prints a line of its own when the disk is full, and cannot be told not to.
    if (result.err.starts_with("** ERROR: NWAD")) {
      result.err.erase(0, result.err.find('\n') + 1);
    }
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.err.substr(0, 12), "brainshift: ");
    for (const std::string& part : parts) {
      EXPECT_NE(result.err.find(part), std::string::npos) << "no '" << part << "' in: " << result.err;
    }
    EXPECT_TRUE(half_written(scratch->path()).empty());
    for (const char* stage : {"segment", "discretise", "solve", "register", "report"}) {
      const std::filesystem::path folder = std::filesystem::path(at("out")) / stage;
      EXPECT_EQ(std::filesystem::exists(folder), std::filesystem::exists(folder / "stage.json")) << folder;
    }
  }

  static inline std::unique_ptr<ScratchFolder> scratch;
};

}  // namespace brainshift::bad_input
