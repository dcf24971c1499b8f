// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/slicer/check_outputs.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/unit/expect_parts.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::check_outputs_test {

using test::expect_parts;
namespace fs = std::filesystem;

class CheckOutputs : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return (scratch_ / name).string(); }
  /// The sentence that the outputs are refused with; empty when they are not.
  std::string fault(std::map<std::string, std::string> outputs, const std::string& return_file = "") const {
    outputs.insert({{"t1", at("t1.nii.gz")}, {"labels", at("labels.nii.gz")}, {"before", at("before.mrk.json")}});
    return test::refusal([&] { check_outputs(outputs, return_file); });
  }

  test::ScratchFolder scratch_;
  fs::path t1_ = scratch_.write("t1.nii.gz", "the patient's"), labels_ = scratch_.write("labels.nii.gz", "labels");
};

TEST_F(CheckOutputs, LetPassWhatCanBeWritten) {
  EXPECT_EQ(fault({}), "");
  EXPECT_EQ(fault({{"warped", at("w.nii.gz")}, {"transform", at("t.h5")}, {"run", at("a/new/folder")}}), "");
  EXPECT_EQ(fault({{"warped", "a name without a folder.nii.gz"}, {"run", scratch_.path().string()}}, at("r")), "");
  scratch_.write("old.nii.gz", "of an earlier call");
  EXPECT_EQ(fault({{"warped", at("old.nii.gz")}}), "");
}

TEST_F(CheckOutputs, RefuseAnEmptyName) {
  expect_parts(fault({{"displacement", ""}}), {"--displacement is empty", "ends in .nii.gz", "leave the option out"});
  expect_parts(fault({{"run", ""}}), {"--run is empty", "a folder"});
}

TEST_F(CheckOutputs, RefuseAnotherEnding) {
  expect_parts(fault({{"warped", at("w.nii")}}), {"--warped is '", "w.nii'", "must end in .nii.gz"});
  expect_parts(fault({{"brain", at("b.stl")}}), {"--brain", "must end in .vtp"});
}

TEST_F(CheckOutputs, RefuseAPlaceThatCannotBeWritten) {
  expect_parts(fault({{"warped", at("nodir/w.nii.gz")}}), {"--warped", "nodir/w.nii.gz", "no folder " + at("nodir")});
  expect_parts(fault({{"warped", at("t1.nii.gz/w.nii.gz")}}), {"no folder " + at("t1.nii.gz")});
  expect_parts(fault({}, at("nodir/r")), {"--returnparameterfile", "no folder"});
  fs::create_directory(scratch_ / "d.nii.gz");
  expect_parts(fault({{"error", at("d.nii.gz")}}), {"--error", "is a folder"});
  expect_parts(fault({{"run", at("t1.nii.gz")}}), {"--run", "is a file"});
  expect_parts(fault({{"run", at("t1.nii.gz/a/run")}}), {"--run", at("t1.nii.gz") + " is a file"});
  if (::geteuid() != 0) {  // root may write anywhere
    fs::permissions(scratch_ / "d.nii.gz", fs::perms::owner_read | fs::perms::owner_exec);
    expect_parts(fault({{"warped", at("d.nii.gz/w.nii.gz")}}), {"--warped", "may not write into its folder"});
    expect_parts(fault({{"run", at("d.nii.gz")}}), {"--run", "may not write"});
  }
}

TEST_F(CheckOutputs, RefuseToWriteOverAnInput) {
  expect_parts(fault({{"warped", at("t1.nii.gz")}}), {"--warped", "is --t1, too", "written over", "another file"});
  expect_parts(fault({{"warpedlabels", at("../") + scratch_.path().filename().string() + "/labels.nii.gz"}}),
               {"--warpedlabels", "is --labels"});
  fs::create_symlink(t1_, scratch_ / "link.nii.gz");
  expect_parts(fault({{"error", at("link.nii.gz")}}), {"--error", "is --t1"});
  expect_parts(fault({}, at("t1.nii.gz")), {"--returnparameterfile", "is --t1"});
  expect_parts(fault({{"labels_are", at("table.txt")}}, at("table.txt")), {"--returnparameterfile", "is --labels_are"});
}

TEST_F(CheckOutputs, RefuseOneFileForTwoOutputs) {
  expect_parts(fault({{"warped", at("w.nii.gz")}, {"error", at("./w.nii.gz")}}), {"--error", "is --warped, too"});
}

}  // namespace brainshift::pipelines::check_outputs_test
