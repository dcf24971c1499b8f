// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <cmath>
#include <stdexcept>

#include "pipelines/report/canvas.hpp"

namespace brainshift::pipelines {

namespace {

// The letters as coverage, 0 to 255, rows from the bottom up as VTK has them. The library's own font, no file needed.
void render_letters(const std::string& text, const TextStyle& style, vtkImageData* letters) {
  vtkNew<vtkTextProperty> property;
  property->SetFontFamilyToArial();
  property->SetFontSize(style.size);
  property->SetBold(style.bold);
  property->SetColor(1, 1, 1);
  vtkFreeTypeTools* tools = vtkFreeTypeTools::GetInstance();
  tools->SetScaleToPowerTwo(false);
  constexpr int pixels_per_inch = 72;
  if (!tools->RenderString(property, vtkStdString(text), pixels_per_inch, letters)) {
    throw std::runtime_error("VTK could not draw the text '" + text + "'");
  }
}

}  // namespace

void draw_text(Canvas& canvas, const Eigen::Vector2d& position, const std::string& text, const TextStyle& style) {
  vtkNew<vtkImageData> letters;
  render_letters(text, style, letters);
  int size[3];
  letters->GetDimensions(size);
  const double shift = style.anchor == Anchor::left ? 0 : style.anchor == Anchor::centre ? 0.5 : 1.0;
  const int left = static_cast<int>(std::lround(position.x() - shift * size[0]));
  const int top = static_cast<int>(std::lround(position.y() - 0.5 * size[1]));
  const auto* coverage = static_cast<const std::uint8_t*>(letters->GetScalarPointer());
  const auto share = [&](int x, int y) {
    return coverage[(static_cast<std::size_t>(size[1] - 1 - y) * static_cast<std::size_t>(size[0]) +
                     static_cast<std::size_t>(x)) *
                        4 +
                    3] /
           255.0;
  };
  for (int pass = style.halo ? 0 : 1; pass < 2; ++pass) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) {
        if (pass == 1) {
          blend_pixel(canvas, left + x, top + y, style.fill, share(x, y));
          continue;
        }
        for (int neighbour = 0; neighbour < 9; ++neighbour) {
          blend_pixel(canvas, left + x + neighbour % 3 - 1, top + y + neighbour / 3 - 1, colour::black,
                      0.5 * share(x, y));
        }
      }
    }
  }
}

}  // namespace brainshift::pipelines
