// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/report.hpp"

#include <gtest/gtest.h>

#include "pipelines/checksum/sha256.hpp"
#include "segmentation/files/surface_file.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/unit/pipelines/report/small_run.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::report_unit_test {

namespace fs = std::filesystem;
using brainshift::test::bytes_of;
using brainshift::test::refusal;
using brainshift::test::ScratchFolder;

void write_run(const ScratchFolder& folder) {
  const RunData run = small_run();
  for (const char* stage : {"segment", "solve", "register"}) {
    fs::create_directory(folder / stage);
  }
  write_image(folder / "t1.nii.gz", *run.t1);
  write_image(folder / "register/warped.nii.gz", *run.warped);
  write_surface(folder / "segment/brain.vtp", *run.brain);
  write_solution(folder / "solve/solution.vtu", *run.solution);
  folder.write("solve/history.csv", "step,time,error_bound_mm,residual,external_work_mJ\n0,0,1,1,0\n9,1,0.1,0.1,2\n");
  const nlohmann::json record = {{"inputs",
                                  {{{"role", "image.t1"},
                                    {"path", (folder / "t1.nii.gz").string()},
                                    {"sha256", sha256_of_file(folder / "t1.nii.gz")}}}},
                                 {"options", {{"solve", {{"tolerance", "0.1"}}}}},
                                 {"stages", nlohmann::json::object()}};
  folder.write("run.json", record.dump());
}

TEST(Report, IsOnePageAndItsPicturesAsFiles) {
  const ScratchFolder folder;
  write_run(folder);
  write_report(folder.path(), folder / "page");
  const std::string page = bytes_of(folder / "page/index.html");
  for (const char* name : {"axial_before", "coronal_after", "sagittal_difference", "axial_displacement", "surface"}) {
    EXPECT_TRUE(fs::exists(folder / ("page/" + std::string(name) + ".svg"))) << name;
    EXPECT_NE(page.find("id=\"" + std::string(name) + "\""), std::string::npos) << name;
  }
  EXPECT_NE(page.find("4 mm"), std::string::npos);
  EXPECT_NE(page.find("How the solver converged"), std::string::npos);
}

void change_record(const ScratchFolder& folder, const std::function<void(nlohmann::json&)>& change) {
  auto record = nlohmann::json::parse(bytes_of(folder / "run.json"));
  change(record);
  folder.write("run.json", record.dump());
}

TEST(Report, ShowsNothingOfAnOutdatedStage) {
  const ScratchFolder folder;
  write_run(folder);
  change_record(folder, [](nlohmann::json& record) {
    record["stages"]["register"] = {{"status", "outdated"}, {"measures", {{"folded_voxels", 7654321}}}};
  });
  write_report(folder.path(), folder / "page");
  const std::string page = bytes_of(folder / "page/index.html");
  EXPECT_NE(page.find("What the stage register left is of an earlier run"), std::string::npos);
  EXPECT_NE(page.find("No image was warped"), std::string::npos);
  EXPECT_EQ(page.find("7,654,321"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "page/axial_before.svg"));
}

TEST(Report, ShowsNoImageThatHasChangedSinceTheRun) {
  const ScratchFolder folder;
  write_run(folder);
  ScalarImage other = *small_run().t1;
  other.voxels.front() += 1;
  write_image(folder / "t1.nii.gz", other);
  write_report(folder.path(), folder / "page");
  EXPECT_NE(bytes_of(folder / "page/index.html").find("t1.nii.gz, has changed since"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "page/axial_before.svg"));
}

TEST(Report, RefusesARecordThatIsNone) {
  for (const std::string record :
       {"[]", R"({"version": 1})", R"({"inputs": 5})", R"({"stages": {"solve": {"seconds": null}}})"}) {
    const ScratchFolder folder;
    folder.write("run.json", record);
    EXPECT_NE(refusal([&] { write_report(folder.path(), folder / "page"); }).find("run.json"), std::string::npos)
        << record;
  }
}

TEST(Report, RefusesAFolderThatIsNoRun) {
  const ScratchFolder folder;
  EXPECT_NE(refusal([&] { write_report(folder.path(), folder / "page"); }).find("run.json"), std::string::npos);
  folder.write("run.json", "{ half");
  EXPECT_NE(refusal([&] { write_report(folder.path(), folder / "page"); }).find("run.json"), std::string::npos);
}

TEST(Report, SaysWhichFolderItCannotMake) {
  const ScratchFolder folder;
  write_run(folder);
  folder.write("file", "");
  EXPECT_THROW(write_report(folder.path(), folder / "file/page"), std::runtime_error);
}

}  // namespace brainshift::pipelines::report_unit_test
