// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/stage_memory.hpp"

#include <gtest/gtest.h>

#include <array>

namespace brainshift::pipelines::stage_memory_test {

constexpr std::array stages = {StageId::segment, StageId::discretise, StageId::solve, StageId::registration,
                               StageId::report};

struct Peak {
  double least, most;  ///< MiB over runs on one to four threads
};

/// What /usr/bin/time said of each stage in a process of its own.
struct Measured {
  const char* name;
  double voxels, nodes;
  bool classified;
  std::array<Peak, 5> peaks;
};

constexpr double colin = 181.0 * 217 * 181;

constexpr std::array measured = {
    Measured{"phantom", 24 * 24 * 24, 300, false, {{{66, 66}, {68, 68}, {77, 77}, {103, 103}, {95, 95}}}},
    Measured{"phantom", 24 * 24 * 24, 3000, false, {{{66, 66}, {66, 66}, {122, 122}, {103, 103}, {96, 96}}}},
    Measured{"phantom", 48 * 48 * 48, 1000, false, {{{87, 95}, {91, 91}, {98, 100}, {89, 89}, {102, 102}}}},
    Measured{"phantom", 96 * 96 * 96, 3000, false, {{{84, 95}, {66, 67}, {119, 123}, {113, 113}, {130, 132}}}},
    Measured{"phantom", 96 * 96 * 96, 12000, false, {{{84, 84}, {70, 70}, {269, 269}, {117, 117}, {134, 134}}}},
    Measured{"phantom", 192 * 192 * 192, 1000, false, {{{189, 189}, {147, 147}, {147, 147}, {485, 485}, {377, 377}}}},
    Measured{"phantom", 192 * 192 * 192, 12000, false, {{{189, 240}, {147, 148}, {293, 301}, {483, 645}, {337, 377}}}},
    Measured{"demo", colin, 1000, true, {{{397, 397}, {132, 132}, {133, 133}, {672, 672}, {365, 365}}}},
    Measured{"demo", colin, 3000, true, {{{342, 342}, {132, 132}, {147, 147}, {552, 552}, {365, 365}}}},
    Measured{"demo", colin, 12000, true, {{{342, 383}, {132, 132}, {294, 297}, {545, 638}, {365, 365}}}},
    Measured{"demo", colin, 24000, true, {{{342, 342}, {132, 132}, {492, 492}, {548, 548}, {365, 365}}}},
    Measured{"demo", colin, 48000, true, {{{342, 342}, {132, 132}, {898, 898}, {552, 552}, {365, 365}}}},
};

Scene scene_of(bool classified) {
  Scene scene;
  (classified ? scene.image.brain_mask : scene.image.labels) = "image.nii.gz";
  scene.tissues.push_back({.label = 1, .name = "parenchyma", .named_material = "", .material = {}});
  scene.load.emplace();
  scene.contact.emplace();
  return scene;
}

/// As explain_scene() takes it from the scene: eight points a cell and 44.6 nodes a point.
RunSize size_of(double voxels, double nodes) {
  const double points = 6 * nodes;
  return {.solve = {.volume = 1.2e6, .nodes = nodes, .points = points, .pairs = 44.6 * points},
          .voxels = voxels,
          .label_voxels = voxels};
}

TEST(StageMemory, IsNoLessThanEveryRunHeldAndAtMostHalfAbove) {
  for (const Measured& run : measured) {
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const double estimate =
          stage_memory(stages[i], scene_of(run.classified), size_of(run.voxels, run.nodes)).value_or(0);
      EXPECT_GE(estimate, run.peaks[i].most) << run.name << " " << run.voxels << " " << run.nodes << " stage " << i;
      EXPECT_LE(estimate, 1.5 * run.peaks[i].least) << run.name << " " << run.voxels << " " << run.nodes << " " << i;
    }
  }
}

TEST(StageMemory, GrowsWithWhatTheSceneAsksFor) {
  const RunSize size = size_of(96 * 96 * 96, 6000);
  Scene scene = scene_of(false);
  const double single = *stage_memory(StageId::solve, scene, size);
  scene.solve.precision = solve::Precision::double_precision;
  const double twice = *stage_memory(StageId::solve, scene, size);
  EXPECT_GE(single, 169) << "measured";
  EXPECT_GE(twice, 190) << "measured";
  EXPECT_GT(twice, single);
  RunSize finer_labels = size;
  finer_labels.label_voxels *= 8;
  EXPECT_GT(*stage_memory(StageId::segment, scene, finer_labels), *stage_memory(StageId::segment, scene, size) + 80);
}

TEST(StageMemory, IsUnknownWhereAdaptiveIntegrationAddsPoints) {
  Scene scene = scene_of(false);
  scene.solve.integration_tolerance = 0.1;
  EXPECT_FALSE(stage_memory(StageId::solve, scene, size_of(1e6, 3000)).has_value());
  EXPECT_TRUE(stage_memory(StageId::report, scene, size_of(1e6, 3000)).has_value());
}

}  // namespace brainshift::pipelines::stage_memory_test
