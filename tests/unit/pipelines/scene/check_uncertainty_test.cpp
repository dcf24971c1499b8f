// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/check_uncertainty.hpp"

#include <gtest/gtest.h>

#include "segmentation/files/surface_file.hpp"
#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::check_uncertainty_test {

class CheckUncertainty : public SceneFile {
 protected:
  /// The fault of a scene with this in it.
  std::string fault_with(const std::string& uncertainty, const std::string& load_attributes = "") {
    write_image(folder_ / "labels.nii.gz", block_labels());
    write_load();
    return fault(
        "<scene><image labels=\"labels.nii.gz\"/><tissues><tissue label=\"1\"/><tissue label=\"3\"/></tissues>"
        "<load" +
        load_attributes + "><craniotomy file=\"load.csv\"/></load>" + uncertainty + "</scene>");
  }
};

TEST_F(CheckUncertainty, TakesWhatIsUncertain) {
  EXPECT_EQ(fault_with("<uncertainty/>"), "");
  EXPECT_EQ(fault_with("<uncertainty samples=\"8\" seed=\"3\" stiffness=\"0.1\" poisson=\"0\"/>"), "");
  EXPECT_EQ(fault_with("<uncertainty stiffness=\"0\" poisson=\"0\"/>", " noise=\"0.5\""), "");
}

TEST_F(CheckUncertainty, RefusesNumbersOfSamplesThatAreNone) {
  for (const char* samples : {"0", "1", "1000000", "many"}) {
    expect_parts(fault_with(std::string("<uncertainty samples=\"") + samples + "\"/>"),
                 {"scene.xml:1", "samples", samples, "a whole number from 2 to 1000"});
  }
}

TEST_F(CheckUncertainty, RefusesASceneWhoseConstantsAreKnownAndWhoseLoadHasNoNoise) {
  expect_parts(fault_with("<uncertainty stiffness=\"0\" poisson=\"0\"/>"),
               {"scene.xml:1", "nothing of the scene is uncertain", "give <load> a noise"});
}

TEST_F(CheckUncertainty, RefusesNoiseThatIsNegative) {
  expect_parts(fault_with("<uncertainty/>", " noise=\"-0.5\""), {"scene.xml:1", "noise", "-0.5"});
}

TEST_F(CheckUncertainty, RefusesAPointWithoutTheNoiseThatOthersHave) {
  EXPECT_EQ(fault_with("<uncertainty/>"), "");
  std::ofstream(folder_ / "load.csv") << "# frame: LPS\nx,y,z,ux,uy,uz,sigma\n1,1,1,0,0,-1,0.5\n2,1,1,0,0,-1,\n";
  const std::string text =
      "<scene><image labels=\"labels.nii.gz\"/><tissues><tissue label=\"1\"/><tissue label=\"3\"/></tissues><load>"
      "<craniotomy file=\"load.csv\"/></load><uncertainty/></scene>";
  expect_parts(fault(text), {"load.csv:4:"});
}

TEST_F(CheckUncertainty, RefusesMotionInTime) {
  expect_parts(fault_with("<uncertainty/><stage name=\"solve\" dynamics=\"transient\"/>"),
               {"<uncertainty> does not go with motion in time"});
}

TEST_F(CheckUncertainty, RefusesASeptum) {
  std::ofstream(folder_ / "falx.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  expect_parts(fault_with("<uncertainty/><septum file=\"falx.obj\"/>"), {"<uncertainty> does not go with a septum"});
}

}  // namespace brainshift::pipelines::check_uncertainty_test
