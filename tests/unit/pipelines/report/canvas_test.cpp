// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/canvas.hpp"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <array>
#include <fstream>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::canvas_test {

TEST(Canvas, BlendsByTheShare) {
  EXPECT_EQ(blend({0, 100, 200}, {100, 0, 200}, 0.25), (Colour{25, 75, 200}));
}

TEST(Canvas, AsPngKeepsEveryPixelAtItsPlace) {
  const test::ScratchFolder folder;
  Canvas canvas(3, 2, colour::black);
  canvas.at(2, 0) = {1, 2, 3};
  canvas.at(0, 1) = {250, 0, 7};
  std::ofstream(folder / "p.png", std::ios::binary) << encode_png(canvas);
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((folder / "p.png").c_str());
  reader->Update();
  const auto pixel = [&](int x, int y) {  // VTK's rows go upwards
    std::array<int, 3> rgb{};
    for (int channel = 0; channel < 3; ++channel) {
      rgb[static_cast<std::size_t>(channel)] =
          static_cast<int>(reader->GetOutput()->GetScalarComponentAsDouble(x, 1 - y, 0, channel));
    }
    return rgb;
  };
  EXPECT_EQ(pixel(2, 0), (std::array{1, 2, 3}));
  EXPECT_EQ(pixel(0, 1), (std::array{250, 0, 7}));
  EXPECT_EQ(pixel(1, 1), (std::array{0, 0, 0}));
}

TEST(Base64, MatchesTheExamplesOfRfc4648) {
  EXPECT_EQ(encode_base64(""), "");
  EXPECT_EQ(encode_base64("f"), "Zg==");
  EXPECT_EQ(encode_base64("fo"), "Zm8=");
  EXPECT_EQ(encode_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encode_base64(std::string("\0\xff\xfe", 3)), "AP/+");
}

}  // namespace brainshift::pipelines::canvas_test
