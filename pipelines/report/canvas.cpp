// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/canvas.hpp"

#include <openssl/evp.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace brainshift::pipelines {

Canvas::Canvas(int width_, int height_, Colour background)
    : width(width_),
      height(height_),
      pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), background) {}

Colour blend(const Colour& a, const Colour& b, double share) {
  Colour mixed;
  for (std::size_t i = 0; i < 3; ++i) {
    mixed[i] = static_cast<std::uint8_t>(std::lround(a[i] + (b[i] - a[i]) * share));
  }
  return mixed;
}

std::string encode_png(const Canvas& canvas) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(canvas.width, canvas.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = static_cast<std::uint8_t*>(image->GetScalarPointer());
  for (int y = canvas.height - 1; y >= 0; --y) {  // VTK's rows go upwards
    for (int x = 0; x < canvas.width; ++x) {
      bytes = std::ranges::copy(canvas.at(x, y), bytes).out;
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
  const std::size_t letters = (bytes.size() + 2) / 3 * 4;
  if (letters >= static_cast<std::size_t>(std::numeric_limits<int>::max())) {  // OpenSSL counts in int
    throw std::length_error("a picture of " + std::to_string(bytes.size()) + " bytes is too large for the page");
  }
  std::string text(letters, '\0');  // OpenSSL ends its text with a null, where std::string has one too
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), reinterpret_cast<const unsigned char*>(bytes.data()),
                  static_cast<int>(bytes.size()));
  return text;
}

}  // namespace brainshift::pipelines
