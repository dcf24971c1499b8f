// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page: well-formed, its pictures readable by others.
#include "pipelines/report/report.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <filesystem>

#include "tests/phantoms/heads/head_runs.hpp"
#include "tests/phantoms/program.hpp"

namespace brainshift::pipelines::report_test {

namespace fs = std::filesystem;

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

// The pixels of all pictures under an element.
void collect_images(const tinyxml2::XMLElement* element, std::vector<std::string>& sources) {
  for (; element != nullptr; element = element->NextSiblingElement()) {
    if (std::string(element->Name()) == "image") {
      sources.emplace_back(element->Attribute("href"));
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
  const std::string text = bytes_of(page);
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(text.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  std::vector<std::string> sources;
  collect_images(document.RootElement(), sources);
  return sources;
}

TEST(Report, IsWellFormedAndHoldsItsPictures) {
  const ScratchFolder scratch;
  const auto sources = images_of_page(oblique_run().folder / "report/index.html");
  EXPECT_EQ(sources.size(), 17U);  // three planes of five, and the surface from two sides
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
  const ScratchFolder scratch;
  fs::copy(oblique_run().folder, scratch / "run", fs::copy_options::recursive);
  fs::remove_all(scratch / "run/register");
  nlohmann::json record = oblique_run().record;
  record["inputs"] = nlohmann::json::array();
  write_text(scratch / "run/run.json", record.dump());
  write_report(scratch / "run", scratch / "page");
  EXPECT_EQ(images_of_page(scratch / "page/index.html").size(), 8U);
  EXPECT_NE(bytes_of(scratch / "page/index.html").find("no image to warp"), std::string::npos);
}

TEST(Report, SaysSoWhenTheLoadIsSimulated) {
  const ScratchFolder scratch;
  write_text(scratch / "run.json", R"({"options": {"load": {}, "load.simulated": {"depth": "8"}}, "stages": {}})");
  write_report(scratch.path(), scratch / "page");
  EXPECT_NE(bytes_of(scratch / "page/index.html").find("The load is simulated"), std::string::npos);
  EXPECT_EQ(bytes_of(oblique_run().folder / "report/index.html").find("The load is simulated"), std::string::npos);
}

TEST(Report, RefusesAFolderThatIsNoRun) {
  const ScratchFolder scratch;
  EXPECT_THROW(write_report(scratch.path(), scratch / "page"), std::invalid_argument);
  write_text(scratch / "run.json", "{ half");
  EXPECT_THROW(write_report(scratch.path(), scratch / "page"), std::invalid_argument);
}

}  // namespace brainshift::pipelines::report_test
