// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <omp.h>

#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "segmentation/files/surface_file.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "tests/unit/pipelines/run_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::pipelines {

/// A brain that is a ball of 20 mm, ball.vtp, and a load that presses its top down by 1 mm, load.csv.
class BallFolder : public RunFolder {
 protected:
  void SetUp() override {
    omp_set_num_threads(1);  // of a few nodes each thread would mostly wait for the others
    const Surface ball = brainshift::test::sphere({0, 0, 0}, 20, 3);
    write_surface(folder_ / "ball.vtp", ball);
    solve::CraniotomyLoad load{Points(0, 3), Points(0, 3)};
    for (const auto& vertex : ball.vertices.rowwise()) {
      if (vertex[2] > 16) {
        load.positions.conservativeResize(load.positions.rows() + 1, 3);
        load.positions.bottomRows(1) = vertex;
      }
    }
    load.displacement = Eigen::RowVector3d(0, 0, -1).replicate(load.positions.rows(), 1);
    solve::write_craniotomy_csv(folder_ / "load.csv", load);
  }
  /// Lets the load press by 1 mm amid it and by a fifth of that where it ends: what moves alike deforms nothing.
  void press_unevenly() const {
    solve::CraniotomyLoad load = solve::read_craniotomy_csv(folder_ / "load.csv");
    load.displacement.col(2) = (15 - load.positions.col(2).array()) / 5;
    solve::write_craniotomy_csv(folder_ / "load.csv", load);
  }
  void TearDown() override { omp_set_num_threads(threads_); }

  /// Its scene, of 60 nodes and without a T1, checked.
  Scene ball_scene(const std::vector<std::string>& overrides = {}, const std::string& more = "") const {
    const fs::path file = write("scene.xml", R"(<scene version="1"><image surface="ball.vtp"/>
      <tissues><tissue label="1" material="brain"/></tissues>
      <load><craniotomy file="load.csv"/></load>
      <stage name="discretise" nodes="60"/>
      <stage name="solve" basis="linear" points_per_cell="1" tolerance="0.1"/>)" +
                                                 more + "</scene>");
    const Scene scene = parse_scene(file, overrides);
    check_scene(scene);
    return scene;
  }

 private:
  const int threads_ = omp_get_max_threads();
};

}  // namespace brainshift::pipelines
