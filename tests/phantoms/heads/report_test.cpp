// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page: well-formed, its pictures readable by others, its verdicts those of the bounds.
#include <gtest/gtest.h>
#include <tinyxml2.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "pipelines/report/canvas.hpp"
#include "pipelines/report/measure_table.hpp"
#include "pipelines/report/report.hpp"
#include "pipelines/report/slice_plane.hpp"
#include "segmentation/surface/surface.hpp"
#include "tests/phantoms/heads/head_runs.hpp"
#include "tests/phantoms/program.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

// Independent of the encoder: six bits a letter, looked up one by one.
std::string decode_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : text) {
    const std::size_t value = letters.find(c);
    if (value == std::string::npos) {
      break;
    }
    bits = bits << 6 | static_cast<unsigned>(value);
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes += static_cast<char>(bits >> held & 255U);
    }
  }
  return bytes;
}

// Sources of all <img> under an element.
void collect_images(const tinyxml2::XMLElement* element, std::vector<std::string>& sources) {
  for (; element != nullptr; element = element->NextSiblingElement()) {
    if (std::string(element->Name()) == "img") {
      sources.emplace_back(element->Attribute("src"));
    }
    collect_images(element->FirstChildElement(), sources);
  }
}

struct ReadPicture {
  int width;
  int height;
  double darkest;
  double brightest;
};

ReadPicture read_png(const fs::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  int size[3];
  double range[2];
  reader->GetOutput()->GetDimensions(size);
  reader->GetOutput()->GetScalarRange(range);
  return {size[0], size[1], range[0], range[1]};
}

// The page is written as XML too, so an XML parser tells whether every tag is closed.
std::vector<std::string> images_of_page(const fs::path& page) {
  const std::string text = read_text(page);
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(text.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  std::vector<std::string> sources;
  collect_images(document.RootElement(), sources);
  return sources;
}

TEST(Report, IsWellFormedAndHoldsItsPictures) {
  const ScratchFolder scratch("page");
  const auto sources = images_of_page(oblique_run().folder / "report/index.html");
  EXPECT_GE(sources.size(), 13U);  // three planes of four, and the surface
  const std::string prefix = "data:image/png;base64,";
  for (const std::string& source : sources) {
    ASSERT_TRUE(source.starts_with(prefix));
    write_text(scratch / "picture.png", decode_base64(source.substr(prefix.size())));
    const ReadPicture picture = read_png(scratch / "picture.png");
    EXPECT_GT(picture.width, 200);
    EXPECT_GT(picture.height, 200);
    EXPECT_GT(picture.brightest, picture.darkest + 100);
  }
}

TEST(Report, WorksWithoutAnImage) {
  const ScratchFolder scratch("no_image");
  fs::copy(oblique_run().folder, scratch / "run", fs::copy_options::recursive);
  fs::remove_all(scratch / "run/register");
  nlohmann::json record = oblique_run().record;
  record["inputs"] = nlohmann::json::array();
  write_text(scratch / "run/run.json", record.dump());
  write_report(scratch / "run", scratch / "page");
  EXPECT_EQ(images_of_page(scratch / "page/index.html").size(), 4U);
  EXPECT_NE(read_text(scratch / "page/index.html").find("no image to warp"), std::string::npos);
}

TEST(Report, SaysSoWhenTheLoadIsSimulated) {
  const ScratchFolder scratch("simulated");
  write_text(scratch / "run.json", R"({"options": {"load": {}, "load.simulated": {"depth": "8"}}, "stages": {}})");
  write_report(scratch.path(), scratch / "page");
  EXPECT_NE(read_text(scratch / "page/index.html").find("The load is simulated"), std::string::npos);
  EXPECT_EQ(read_text(oblique_run().folder / "report/index.html").find("The load is simulated"), std::string::npos);
}

TEST(Report, RefusesAFolderThatIsNoRun) {
  const ScratchFolder scratch("no_run");
  EXPECT_THROW(write_report(scratch.path(), scratch / "page"), std::invalid_argument);
  write_text(scratch / "run.json", "{ half");
  EXPECT_THROW(write_report(scratch.path(), scratch / "page"), std::invalid_argument);
}

TEST(MeasureTable, JudgesByTheBound) {
  const auto verdict_of = [](double error) {
    const nlohmann::json record = {{"stages", {{"solve", {{"measures", {{"constraint_error_mm", error}}}}}}}};
    return quality_measures(record).at(0).verdict;
  };
  EXPECT_EQ(verdict_of(0.05), Verdict::within);
  EXPECT_EQ(verdict_of(0.051), Verdict::outside);
  EXPECT_EQ(verdict_of(std::nan("")), Verdict::outside);
}

TEST(Base64, MatchesTheExamplesOfRfc4648) {
  EXPECT_EQ(encode_base64(""), "");
  EXPECT_EQ(encode_base64("f"), "Zg==");
  EXPECT_EQ(encode_base64("fo"), "Zm8=");
  EXPECT_EQ(encode_base64("foobar"), "Zm9vYmFy");
}

TEST(SlicePlane, ShowsThePatientsLeftOnTheRightWhateverTheImagesAxes) {
  ScalarImage image;
  image.geometry.size = {30, 30, 30};
  image.geometry.direction << 0, 0, -1, 0, 1, 0, -1, 0, 0;
  image.geometry.origin = {29, 0, 29};
  image.voxels.resize(image.geometry.voxel_count());
  for (int k = 0; k < 30; ++k) {
    for (int j = 0; j < 30; ++j) {
      for (int i = 0; i < 30; ++i) {
        image.at(i, j, k) = static_cast<float>(image.geometry.to_world({i * 1.0, j * 1.0, k * 1.0}).x());
      }
    }
  }
  const auto planes = anatomical_planes({15, 15, 15}, {2, 2, 2}, {28, 28, 28}, 2);
  const SlicePlane& axial = planes[0];
  const auto values = sample_slice(axial, image);
  for (const int x : {4, 20, 40}) {
    const double expected = axial.world({x + 0.5, 10.5}).x();
    EXPECT_NEAR(values[static_cast<std::size_t>(10 * axial.width + x)], expected, 1e-4);
  }
  EXPECT_EQ(axial.letters[1], 'L');
  EXPECT_GT(axial.right.x(), 0);  // LPS: x grows towards the patient's left
}

TEST(SlicePlane, MaskOfACutCubeHasTheCubesArea) {
  Surface cube;
  cube.vertices = Points(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    cube.vertices.row(corner) << 10 * (corner & 1), 10 * (corner >> 1 & 1), 10 * (corner >> 2 & 1);
  }
  cube.triangles = Triangles(12, 3);
  cube.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5,
      3, 7, 5;
  for (const SlicePlane& plane : anatomical_planes({5, 5, 5}, {-5, -5, -5}, {15, 15, 15}, 4)) {
    const auto mask = inside_mask(plane, cut_surface(plane, cube));
    EXPECT_EQ(std::ranges::count(mask, 1), 40 * 40) << plane.name;
  }
}

}  // namespace
}  // namespace brainshift::pipelines
