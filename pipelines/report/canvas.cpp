// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace brainshift::pipelines {

using Eigen::Vector2d;

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

void blend_pixel(Canvas& canvas, int x, int y, const Colour& over, double share) {
  if (x >= 0 && y >= 0 && x < canvas.width && y < canvas.height && share > 0) {
    canvas.at(x, y) = blend(canvas.at(x, y), over, std::min(share, 1.0));
  }
}

void draw_line(Canvas& canvas, const Vector2d& from, const Vector2d& to, double width, const Colour& stroke) {
  const double reach = width / 2 + 1;
  const Vector2d low = from.cwiseMin(to) - Vector2d::Constant(reach);
  const Vector2d high = from.cwiseMax(to) + Vector2d::Constant(reach);
  const int x_end = std::min(canvas.width - 1, static_cast<int>(high.x()));
  const int y_end = std::min(canvas.height - 1, static_cast<int>(high.y()));
  const Vector2d along = to - from;
  const double length_squared = std::max(along.squaredNorm(), 1e-12);
  for (int y = std::max(0, static_cast<int>(low.y())); y <= y_end; ++y) {
    for (int x = std::max(0, static_cast<int>(low.x())); x <= x_end; ++x) {
      const Vector2d pixel(x + 0.5, y + 0.5);
      const double t = std::clamp((pixel - from).dot(along) / length_squared, 0.0, 1.0);
      const double distance = (pixel - from - t * along).norm();
      blend_pixel(canvas, x, y, stroke, width / 2 + 0.5 - distance);
    }
  }
}

void draw_arrow(Canvas& canvas, const Vector2d& from, const Vector2d& to, double width, const Colour& stroke) {
  draw_line(canvas, from, to, width, stroke);
  const double length = (to - from).norm();
  if (length < 1) {
    return;
  }
  const Vector2d along = (to - from) / length;
  const Vector2d across(-along.y(), along.x());
  const double head = std::min(0.45 * length, 3.5 * width + 2);
  for (const double side : {-0.5, 0.5}) {
    draw_line(canvas, to, to - head * along + side * head * across, width, stroke);
  }
}

void fill_rectangle(Canvas& canvas, int x, int y, int width, int height, const Colour& fill) {
  for (int row = std::max(0, y); row < std::min(canvas.height, y + height); ++row) {
    for (int column = std::max(0, x); column < std::min(canvas.width, x + width); ++column) {
      canvas.at(column, row) = fill;
    }
  }
}

void paste(Canvas& canvas, const Canvas& picture, int x, int y) {
  for (int row = std::max(0, -y); row < std::min(picture.height, canvas.height - y); ++row) {
    for (int column = std::max(0, -x); column < std::min(picture.width, canvas.width - x); ++column) {
      canvas.at(x + column, y + row) = picture.at(column, row);
    }
  }
}

}  // namespace brainshift::pipelines
