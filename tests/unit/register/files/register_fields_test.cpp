// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/register_fields.hpp"

#include <gtest/gtest.h>

#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::register_fields_test {

using namespace builders;

TEST(RegisterFields, PointsTakeTheMapThatGoesTheirWayAndImagesTheOneThatComesBack) {
  const test::ScratchFolder folder;
  const auto write_shift = [&](const char* name, double x) {
    write_image(folder / name,
                field(grid({4, 4, 4}), [&](const Eigen::Vector3d&) { return Eigen::Vector3d(x, 0, 0); }));
  };
  write_shift("preop_to_intraop.nii.gz", 1);
  write_shift("intraop_to_preop.nii.gz", -1);
  RegisterFields there(folder.path(), Towards::intraop), back(folder.path(), Towards::preop);
  EXPECT_EQ(there.of_points().at(0, 0, 0)[0], 1);
  EXPECT_EQ(there.of_images().at(0, 0, 0)[0], -1);
  EXPECT_EQ(back.of_points().at(0, 0, 0)[0], -1);
  EXPECT_EQ(back.of_images().at(0, 0, 0)[0], 1);
}

TEST(RegisterFields, AFolderWithoutThemIsRefused) {
  const test::ScratchFolder folder;
  const std::string said = test::refusal([&] { RegisterFields(folder.path(), Towards::intraop); });
  EXPECT_NE(said.find("preop_to_intraop.nii.gz"), std::string::npos);
  EXPECT_NE(said.find("finished run"), std::string::npos);
}

}  // namespace brainshift::registration::register_fields_test
