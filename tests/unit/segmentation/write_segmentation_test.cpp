// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/segment.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::test::write_segmentation_test {

using segmentation::Segmentation;
using segmentation::write_segmentation;

/// A brain in its skull with two tissues, as it comes of a surface.
Segmentation of_surfaces() {
  Segmentation result;
  result.brain = sphere({1, 2, 3}, 20, 1);
  result.skull = sphere({1, 2, 3}, 22, 1);
  result.tissues[2] = tetrahedron();
  result.tissues[30] = box({0, 0, 0}, {1, 2, 3});
  return result;
}

std::set<std::string> files_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

TEST(WriteSegmentation, HasAFileForEachSurfaceThatIsReadBackTheSame) {
  const ScratchFolder folder;
  const Segmentation result = of_surfaces();
  write_segmentation(folder / "made/in/here", result);
  const auto in = [&](const char* name) { return read_surface(folder / "made/in/here" / name); };
  EXPECT_EQ(in("brain.vtp").vertices, result.brain.vertices);
  EXPECT_EQ(in("skull.vtp").triangles, result.skull.triangles);
  EXPECT_EQ(in("tissue_2.vtp").vertices, result.tissues.at(2).vertices);
  EXPECT_EQ(in("tissue_30.vtp").vertices, result.tissues.at(30).vertices);
  EXPECT_EQ(files_in(folder / "made/in/here"),
            (std::set<std::string>{"brain.vtp", "skull.vtp", "tissue_2.vtp", "tissue_30.vtp"}))
      << "no labels, no memberships";
}

TEST(WriteSegmentation, HasTheLabelsAndAMembershipForEachClassInTheirOrder) {
  const ScratchFolder folder;
  Segmentation result = of_surfaces();
  const ImageGeometry grid = grid_around({1, 2, 3}, 6, {1, 2, 3}, oblique_left_handed());
  result.labels = ball(grid, {1, 2, 3}, 4);
  for (const float share : {0.25F, 0.75F}) {
    result.memberships.push_back({grid, std::vector<float>(grid.voxel_count(), share)});
  }
  write_segmentation(folder.path(), result);
  const LabelMap labels = read_label_map(folder / "labels.nii.gz");
  EXPECT_EQ(labels.voxels, result.labels->voxels);
  EXPECT_TRUE(same_geometry(labels.geometry, grid));
  EXPECT_EQ(read_image(folder / "membership_0.nii.gz").voxels, result.memberships[0].voxels);
  EXPECT_EQ(read_image(folder / "membership_1.nii.gz").voxels, result.memberships[1].voxels);
}

TEST(WriteSegmentation, SaysWhichFolderCannotBeMade) {
  const ScratchFolder folder;
  folder.write("taken", "a file");
  EXPECT_TRUE(throws_saying<std::runtime_error>([&] { write_segmentation(folder / "taken/below", of_surfaces()); },
                                                {(folder / "taken/below").string(), "cannot be made"}));
}

}  // namespace brainshift::test::write_segmentation_test
