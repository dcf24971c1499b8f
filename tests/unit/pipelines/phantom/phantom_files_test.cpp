// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pipelines/phantom/phantom.hpp"
#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "segmentation/interface/options.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::phantom_files_test {

using brainshift::test::expect_parts;
using brainshift::test::refusal;
using brainshift::test::ScratchFolder;

constexpr PhantomOptions small{.size = 24, .spacing = 8};

TEST(PhantomFiles, AreWhatWasMade) {
  const ScratchFolder folder;
  write_phantom(small, folder / "new/folder");
  const std::filesystem::path out = folder / "new/folder";
  const Phantom phantom = make_phantom(small);
  EXPECT_EQ(read_image(out / "t1.nii.gz").voxels, sample_t1(phantom, small.seed).voxels);
  EXPECT_EQ(read_label_map(out / "labels.nii.gz").voxels, sample_labels(phantom).voxels);
  EXPECT_EQ(solve::read_craniotomy_csv(out / "craniotomy.csv").displacement, phantom.load.displacement);
  const Points landmarks = solve::read_markup_positions(out / "landmarks.mrk.json");
  ASSERT_EQ(landmarks.rows(), static_cast<Eigen::Index>(phantom.landmarks.size()));
  EXPECT_EQ(landmarks.row(1).transpose(), phantom.landmarks[1].position);
}

TEST(PhantomFiles, SayTheAnswersThatAreKnown) {
  const ScratchFolder folder;
  write_phantom(small, folder.path());
  const auto answers = nlohmann::json::parse(brainshift::test::bytes_of(folder / "answers.json"));
  const Phantom phantom = make_phantom(small);
  EXPECT_EQ(answers["scale"], 1.0);
  EXPECT_EQ(answers["tissues"]["tumour"]["label"], segmentation::default_label::tumour);
  EXPECT_EQ(answers["tissues"]["tumour"]["volume"], phantom.head.tumour.volume());
  EXPECT_EQ(answers["brain_volume"], phantom.head.brain.volume());
  EXPECT_EQ(answers["opening"]["depth"], phantom.opening.depth);
  EXPECT_EQ(answers["landmarks"]["tumour"][2], phantom.head.tumour.centre.z());
}

TEST(PhantomFiles, HaveASceneThatPassesItsCheckAndKnowsTheSkullWhereThereIsAGap) {
  for (const double gap : {0.0, 3.0}) {
    const ScratchFolder folder;
    PhantomOptions options = small;
    options.csf_gap = gap;
    write_phantom(options, folder.path());
    const Scene scene = parse_scene(folder / "scene.xml", {});
    EXPECT_NO_THROW(check_scene(scene));
    EXPECT_EQ(scene.image.skull_label.has_value(), gap > 0);
    EXPECT_GE(scene.discretise.nodes, 600U);
    EXPECT_TRUE(scene.contact);
  }
}

TEST(PhantomFiles, AreNotMadeFromOptionsOutOfRange) {
  const ScratchFolder folder;
  expect_parts(refusal([&] { write_phantom({.size = 5}, folder / "out"); }), {"size is '5'"});
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(PhantomFiles, ThatCannotBeWrittenAreNamed) {
  const ScratchFolder folder;
  folder.write("taken", "a file");
  std::filesystem::create_directories(folder / "out/answers.json");
  for (const auto& [place, words] : {std::pair<std::string, std::string>("taken/out", "cannot be made"),
                                     std::pair<std::string, std::string>("out", "is a folder")}) {
    try {
      write_phantom(small, folder / place);
      ADD_FAILURE() << place;
    } catch (const std::runtime_error& fault) {
      expect_parts(fault.what(), {words, (folder / place).string()});
    }
  }
}

}  // namespace brainshift::pipelines::phantom_files_test
