// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/check_parts.hpp"

#include <gtest/gtest.h>

#include "segmentation/files/surface_file.hpp"
#include "tests/unit/pipelines/scene_file.hpp"

namespace brainshift::pipelines::check_parts_test {

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

/// Two triangles, or one and its neighbour in two pieces.
Surface small_sheet(bool whole) {
  Surface sheet{Points(6, 3), Triangles(2, 3)};
  sheet.vertices << 0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0, 20, 0, 0, 20, 9, 0;
  sheet.triangles << 0, 1, 2, (whole ? 0 : 3), (whole ? 2 : 4), (whole ? 3 : 5);
  return sheet;
}

TEST_F(SceneFile, CheckRefusesCutsAndResectionsThatCannotBe) {
  write_image(folder_ / "labels.nii.gz", block_labels());
  write_load();
  write_surface(folder_ / "sheet.vtp", small_sheet(true));
  write_surface(folder_ / "pieces.vtp", small_sheet(false));
  std::ofstream(folder_ / "path.csv") << "x,y\n0,0\n9,9\n";
  const auto scene = [](const std::string& inside) {
    return "<scene><image labels=\"labels.nii.gz\"/><tissues><tissue label=\"1\"/><tissue label=\"3\"/></tissues>"
           "<load><craniotomy file=\"load.csv\"/></load>\n" +
           inside + "</scene>";
  };
  const std::string cut = "<cuts>\n<cut file=\"sheet.vtp\"/></cuts>";
  EXPECT_EQ(fault(scene(cut + "<resection labels=\"3\"/>")), "");
  EXPECT_EQ(fault(scene("<cuts><cut file=\"sheet.vtp\" speed=\"9\" direction=\"1 0 0\"/></cuts>")), "");
  expect_parts(fault(scene("<cuts>\n<cut file=\"none.vtp\"/></cuts>")), {"scene.xml:3", "none.vtp", "no such file"});
  expect_parts(fault(scene("<cuts>\n<cut file=\"pieces.vtp\"/></cuts>")), {"scene.xml:3", "pieces.vtp", "pieces"});
  expect_parts(fault(scene("<cuts>\n<cut file=\"path.csv\"/></cuts>")),
               {"scene.xml:3", "path.csv", "brainshift solve --plane", "sheets"});
  expect_parts(fault(scene("<cuts>\n<cut file=\"sheet.vtp\" speed=\"9\"/></cuts>")), {"scene.xml:3", "direction"});
  expect_parts(fault(scene("<cuts/>")), {"scene.xml:2", "names no cut"});
  expect_parts(fault(scene(""), {"cuts.contact=yes"}), {"names no cut"});
  expect_parts(fault(scene("<resection labels=\"2\"/>")), {"scene.xml:2", "label 2", "no tissue", "1 3"});
  expect_parts(fault(scene("<resection labels=\"1 3\"/>")), {"scene.xml:2", "every tissue"});
  expect_parts(fault(scene("<resection labels=\"3\" fluid_level=\"4\"/>")),
               {"scene.xml:2", "which way gravity pulls it"});
  expect_parts(fault(scene("<resection labels=\"\"/>")), {"scene.xml:2", "names no label", "1 3"});
  expect_parts(fault(scene(cut), {"solve.region=1"}), {"--set", "region", "cuts"});
  expect_parts(fault(scene("<resection labels=\"3\"/>"), {"solve.region=1"}), {"--set", "region", "resection"});
}

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

TEST_F(CheckUncertainty, RefusesAShareThatThereIsNot) {
  EXPECT_EQ(fault_with("<uncertainty shares=\"3\" share=\"3\"/>"), "");
  expect_parts(fault_with("<uncertainty shares=\"3\" share=\"4\"/>"), {"scene.xml:1", "share is 4 of 3 shares"});
}

TEST_F(CheckUncertainty, RefusesASceneWhoseConstantsAreKnownAndWhoseLoadHasNoNoise) {
  expect_parts(fault_with("<uncertainty stiffness=\"0\" poisson=\"0\"/>"),
               {"scene.xml:1", "nothing of the scene is uncertain", "give <load> a noise"});
}

TEST_F(CheckUncertainty, RefusesNoiseThatIsNegative) {
  expect_parts(fault_with("<uncertainty/>", " noise=\"-0.5\""), {"scene.xml:1", "noise", "-0.5"});
}

TEST_F(CheckUncertainty, RefusesNoiseBesideWhatItDoesNotGoWith) {
  const std::string in_time = "<stage name=\"solve\" dynamics=\"transient\" duration=\"0.1\"/>";
  EXPECT_EQ(fault_with(in_time), "");
  expect_parts(fault_with(in_time, " noise=\"0.5\""), {"scene.xml:1", "noise", "motion in time"});
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

}  // namespace brainshift::pipelines::check_parts_test
