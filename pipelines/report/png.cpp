// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include "pipelines/report/canvas.hpp"

namespace brainshift::pipelines {

std::string encode_png(const Canvas& canvas) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(canvas.width, canvas.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = static_cast<std::uint8_t*>(image->GetScalarPointer());
  for (int y = canvas.height - 1; y >= 0; --y) {  // VTK's rows go upwards
    for (int x = 0; x < canvas.width; ++x) {
      for (const std::uint8_t channel : canvas.at(x, y)) {
        *bytes++ = channel;
      }
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  auto* result = writer->GetResult();
  return {reinterpret_cast<const char*>(result->GetVoidPointer(0)),
          static_cast<std::size_t>(result->GetNumberOfValues())};
}

std::string encode_base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8 | (i + j < bytes.size() ? static_cast<std::uint8_t>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j <= bytes.size() ? letters[group >> (18 - 6 * j) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace brainshift::pipelines
