// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_any.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "register/warp/warp.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/image/image_series.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/image/drawn_dicom.hpp"

namespace brainshift::registration::warp_any_test {

using test::ScratchFolder;

using namespace builders;

const Eigen::Vector3d shift(1.5, -2, 3);

/// A register folder whose fields shift everything by (1.5, -2, 3) mm.
class WarpAny : public ::testing::Test {
 protected:
  WarpAny() {
    const ImageGeometry g = grid({12, 12, 12}, {4, 4, 4}, oblique());
    write_image(path("preop_to_intraop.nii.gz"), field(g, [](const Eigen::Vector3d&) { return shift; }));
    write_image(path("intraop_to_preop.nii.gz"),
                field(g, [](const Eigen::Vector3d&) -> Eigen::Vector3d { return -shift; }));
  }

  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }

  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }

  void warp(const std::string& in, const std::string& out, const WarpAnyOptions& options = {}) const {
    RegisterFields fields(folder_.path(), Towards::intraop);
    warp_any(path(in), fields, path(out), options);
  }

  std::string refusal(const std::string& in, const std::string& out) const {
    try {
      warp(in, out);
    } catch (const std::invalid_argument& fault) {
      return fault.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
  }

 private:
  ScratchFolder folder_;
};

TEST_F(WarpAny, MovesPointsOfATableAndKeepsItsOtherColumns) {
  write("in.csv", "# frame: LPS\nname,x,y,z,note\nA,3,-5,8,first\n\nB,4.25,-5,8,second\n");
  warp("in.csv", "out.csv");
  EXPECT_EQ(
      read("out.csv"),
      "# frame: LPS\nname,x,y,z,note\nA,4.500000,-7.000000,11.000000,first\n\nB,5.750000,-7.000000,11.000000,second\n");
}

TEST_F(WarpAny, MovesPointsInRasToTheSamePlaceInTheWorld) {
  write("in.csv", "# frame: RAS\nx,y,z\n-3,5,8\n");
  warp("in.csv", "out.csv");
  EXPECT_EQ(read("out.csv"), "# frame: RAS\nx,y,z\n-4.500000,7.000000,11.000000\n");
}

TEST_F(WarpAny, MovesFcsvPoints) {
  write("in.fcsv",
        "# Markups fiducial file version = 4.11\n# CoordinateSystem = 0\n# columns = id,x,y,z,ow\n1,-3,5,8,0\n");
  warp("in.fcsv", "out.fcsv");
  EXPECT_NE(read("out.fcsv").find("\n1,-4.500000,7.000000,11.000000,0\n"), std::string::npos);
}

TEST_F(WarpAny, MovesMarkupsAndKeepsTheirNames) {
  write("in.mrk.json", R"({"markups": [{"type": "Fiducial", "coordinateSystem": "RAS", "controlPoints": [
    {"label": "tumour", "position": [-3, 5, 8], "positionStatus": "defined"},
    {"label": "later", "position": [0, 0, 0], "positionStatus": "undefined"}]}]})");
  warp("in.mrk.json", "out.mrk.json");
  const auto points = nlohmann::json::parse(read("out.mrk.json"))["markups"][0]["controlPoints"];
  EXPECT_EQ(points[0]["label"], "tumour");
  EXPECT_NEAR(points[0]["position"][0], -4.5, 1e-6);
  EXPECT_NEAR(points[0]["position"][1], 7, 1e-6);
  EXPECT_NEAR(points[0]["position"][2], 11, 1e-6);
  EXPECT_EQ(points[1]["position"][0], 0);
}

TEST_F(WarpAny, MovesASurfaceModelForward) {
  for (const std::string ending : {".vtp", ".ply", ".stl", ".obj"}) {
    write_surface(path("in" + ending), ball(centre, 6, 6));
    warp("in" + ending, "out" + ending);
    const Surface moved = read_surface(path("out" + ending));
    const Eigen::RowVector3d middle = (moved.vertices.colwise().maxCoeff() + moved.vertices.colwise().minCoeff()) / 2;
    EXPECT_LT((middle - (centre + shift).transpose()).norm(), 1e-4) << ending;
  }
}

TEST_F(WarpAny, ResamplesImagesAndLabelMapsOnTheirOwnGrid) {
  const ImageGeometry g = grid({20, 20, 20}, {1, 1, 1});
  const auto slope = [](const Eigen::Vector3d& x) { return 100 + x.x() - 2 * x.z(); };
  write_image(path("t1.nii.gz"), image(g, slope));
  write_image(path("labels.nrrd"), label_map(g, [](const Eigen::Vector3d& x) { return x.x() < centre.x() ? 3 : 9; }));
  warp("t1.nii.gz", "t1_out.mha");
  warp("labels.nrrd", "labels_out.nii.gz", {.values = Values::labels, .grid = {}});
  const ScalarImage t1 = read_image(path("t1_out.mha"));
  const LabelMap labels = read_label_map(path("labels_out.nii.gz"));
  ASSERT_TRUE(same_geometry(t1.geometry, g));
  EXPECT_NEAR(t1.at(10, 10, 10), slope(g.to_world({10, 10, 10}) - shift), 1e-3);
  EXPECT_EQ(labels.at(10, 10, 10), 3);
  EXPECT_EQ(labels.at(12, 10, 10), 9);
}

TEST_F(WarpAny, ADicomSeriesComesBackAsAnotherBesideTheImage) {
  std::filesystem::create_directory(path("in"));
  for (int k = 0; k < 8; ++k) {
    test::DrawnSlice slice;
    slice.study = "1.2.3.8";
    slice.frame_of_reference = "1.2.3.7";
    slice.value = static_cast<std::uint64_t>(100 * (k + 1));
    slice.position = "1\\-7\\" + std::to_string(2 * k);
    write("in/" + std::to_string(k), slice.bytes());
  }
  warp("in", "out.nii.gz", {.values = Values::intensities, .grid = {}});
  const ScalarImage image = read_image(path("out.nii.gz")), series = read_image(path("out"));
  ASSERT_TRUE(same_geometry(series.geometry, image.geometry));
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    ASSERT_NEAR(series.voxels[v], image.voxels[v], 0.5001);
  }
  EXPECT_NE(read("out/0001.dcm").find("Warped to intraop by brainshift, NOT FOR DIAGNOSIS"), std::string::npos);
}

TEST_F(WarpAny, ResamplesASeriesVolumeByVolume) {
  const ImageGeometry g = grid({12, 11, 10}, {1, 1.5, 2}, oblique());
  ImageSeries series{.volumes = {}, .start = 0, .step = 2.5};
  for (const double more : {0.0, 10.0, 20.0}) {
    series.volumes.push_back(image(g, [&](const Eigen::Vector3d& x) { return more + texture(x); }));
  }
  write_image_series(path("bold.nii.gz"), series);
  ASSERT_TRUE(is_image_series(path("bold.nii.gz")));
  warp("bold.nii.gz", "bold_out.nii.gz");
  const ImageSeries warped = read_image_series(path("bold_out.nii.gz"));
  ASSERT_EQ(warped.volumes.size(), 3U);
  EXPECT_NEAR(warped.step, 2.5, 1e-6);
  for (const ScalarImage& volume : warped.volumes) {
    const auto t = static_cast<std::size_t>(&volume - warped.volumes.data());
    ASSERT_TRUE(same_geometry(volume.geometry, g));
    write_image(path("one.nii.gz"), series.volumes[t]);
    warp("one.nii.gz", "one_out.nii.gz");
    const ScalarImage alone = read_image(path("one_out.nii.gz"));
    for (std::size_t v = 0; v < alone.voxels.size(); ++v) {
      ASSERT_NEAR(volume.voxels[v], alone.voxels[v], 1e-3);
    }
  }
}

TEST_F(WarpAny, RefusesTablesThatDoNotParseWithFileAndLine) {
  write("frame.csv", "x,y,z\n1,2,3\n");
  EXPECT_NE(refusal("frame.csv", "out.csv").find("frame is not named"), std::string::npos);
  write("header.csv", "# frame: LPS\n1,2,3\n");
  EXPECT_NE(refusal("header.csv", "out.csv").find("header.csv:2"), std::string::npos);
  write("text.csv", "# frame: LPS\nx,y,z\n1,2,3\n1,two,3\n");
  EXPECT_NE(refusal("text.csv", "out.csv").find("text.csv:4"), std::string::npos);
  write("nan.csv", "# frame: LPS\nx,y,z\n1,nan,3\n");
  EXPECT_NE(refusal("nan.csv", "out.csv").find("nan.csv:3"), std::string::npos);
  write("short.csv", "# frame: LPS\nx,y,z\n1,2\n");
  EXPECT_NE(refusal("short.csv", "out.csv").find("short.csv:3"), std::string::npos);
  write("empty.csv", "# frame: LPS\nx,y,z\n");
  EXPECT_NE(refusal("empty.csv", "out.csv").find("no point"), std::string::npos);
  write("scanner.csv", "# frame: scanner\nx,y,z\n1,2,3\n");
  EXPECT_NE(refusal("scanner.csv", "out.csv").find("LPS or RAS"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("out.csv")));
}

TEST_F(WarpAny, RefusesMarkupsThatAreNone) {
  write("cut.mrk.json", R"({"markups": [)");
  EXPECT_NE(refusal("cut.mrk.json", "out.mrk.json").find("cut.mrk.json"), std::string::npos);
  write("other.mrk.json", R"({"something": 1})");
  EXPECT_NE(refusal("other.mrk.json", "out.mrk.json").find("markups"), std::string::npos);
  write("text.mrk.json", R"({"markups": [{"controlPoints": [{"position": ["a", 2, 3]}]}]})");
  EXPECT_NE(refusal("text.mrk.json", "out.mrk.json").find("control point 1"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("out.mrk.json")));
}

TEST_F(WarpAny, RefusesToChangeTheFormatOfPoints) {
  write("in.csv", "# frame: LPS\nx,y,z\n1,2,3\n");
  EXPECT_NE(refusal("in.csv", "out.mrk.json").find(".csv"), std::string::npos);
}

TEST_F(WarpAny, RefusesAnUnknownEndingAndNamesThoseThatAreKnown) {
  write("in.fbx", "a model");
  const std::string said = refusal("in.fbx", "out.fbx");
  EXPECT_NE(said.find("in.fbx: its ending is none that is known"), std::string::npos);
  EXPECT_NE(said.find(".trk"), std::string::npos);
}

TEST_F(WarpAny, RefusesFilesThatAreNotThere) {
  refusal("none.csv", "out.csv");
  refusal("none.mrk.json", "out.mrk.json");
  refusal("none.vtp", "out.vtp");
  refusal("none.nii.gz", "out.nii.gz");
}

}  // namespace brainshift::registration::warp_any_test
