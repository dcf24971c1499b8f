// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/external_command.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "pipelines/runner/stage_folder.hpp"

namespace brainshift::pipelines::external_command_test {

namespace fs = std::filesystem;

class ExternalCommandTest : public testing::Test {
 protected:
  ExternalCommandTest() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("brainshift_runner_" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ExternalCommandTest() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::string read(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  fs::path folder_;
  Interruption interruption_{[](int) {}};
};

TEST_F(ExternalCommandTest, ACommandSeesItsFoldersWhateverTheirNames) {
  const fs::path out = folder_ / "it's out";
  fs::create_directories(out);
  run_external_command({"echo {in} > {out}/said", folder_ / "in here", out, folder_}, interruption_);
  EXPECT_EQ(read(out / "said"), (folder_ / "in here").string() + "\n");
}

TEST_F(ExternalCommandTest, AFailedCommandIsAFaultWithItsCodeAndLastWords) {
  try {
    run_external_command({"echo first; echo no mesh >&2; exit 7", folder_, folder_, folder_}, interruption_);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("code 7"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("no mesh"), std::string::npos) << error.what();
  }
}

}  // namespace brainshift::pipelines::external_command_test
