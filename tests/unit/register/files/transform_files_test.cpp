// SPDX-License-Identifier: GPL-3.0-or-later
// ITK brings an Eigen of its own, which must be read before ours.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "register/files/transform_files.hpp"
#include "segmentation/image/itk_bridge.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/register/read_transform.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::transform_files_test {

using namespace builders;
using test::ScratchFolder;

class TransformFiles : public ::testing::Test {
 protected:
  static VectorImage moving(double to) {
    VectorImage image = field(grid(), [](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
    image.at(6, 6, 6) = {static_cast<float>(to), 2, -1};
    return image;
  }
  std::string path(const char* name, const char* ending) const {
    return (folder_.path() / (std::string(name) + ending)).string();
  }

  const ScratchFolder folder_;
  const VectorImage resampling_ = moving(-3), forward_ = moving(3);
};

TEST_F(TransformFiles, ForImagesHoldTheFieldThatResamplesAndForPointsTheOneThatGoesForward) {
  write_transform_files(folder_.path(), resampling_, forward_);
  const Eigen::Vector3d place = resampling_.geometry.to_world(Eigen::Vector3d(6, 6, 6));
  EXPECT_NEAR(read_transform(path(image_transform, ".h5"))->TransformPoint(place.data())[0], place[0] - 3, 1e-5);
  EXPECT_NEAR(read_transform(path(point_transform, ".h5"))->TransformPoint(place.data())[0], place[0] + 3, 1e-5);
}

TEST_F(TransformFiles, HaveANoteThatNamesFilesThatAreThere) {
  write_transform_files(folder_.path(), resampling_, forward_);
  for (const char* name : {image_transform, point_transform}) {
    std::ifstream in(path(name, ".json"));
    std::ostringstream note;
    note << in.rdbuf();
    EXPECT_NE(note.str().find("\"Frame\": \"LPS\""), std::string::npos);
    EXPECT_NE(note.str().find(std::string("\"") + name + ".h5\""), std::string::npos);
  }
}

TEST_F(TransformFiles, ThatCannotBeWrittenAreNamed) {
  for (const std::string& file : {path(image_transform, ".nrrd"), path(point_transform, ".json")}) {
    std::filesystem::create_symlink("/dev/full", file);
    try {
      write_transform_files(folder_.path(), resampling_, forward_);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& fault) {
      EXPECT_NE(std::string(fault.what()).find(file), std::string::npos) << fault.what();
    }
    std::filesystem::remove(file);
  }
}

}  // namespace brainshift::registration::transform_files_test
