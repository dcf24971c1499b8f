// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/slice_figures.hpp"

#include <algorithm>
#include <cmath>

#include "solve/output/field_difference.hpp"

namespace brainshift::pipelines {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Colour preop_colour = {90, 200, 250};
constexpr Colour intraop_colour = {255, 150, 60};
constexpr Colour opening_colour = {70, 235, 110};
constexpr int bar_width = 96;  // pixels to the right of a picture with a colour bar

// Grey as radiologists see it; where the image has no value, or there is none, nearly black.
void draw_grey(Canvas& canvas, const View& view, const SlicePlane& plane, const std::vector<float>& values,
               double brightness) {
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      const double value = values[static_cast<std::size_t>(y * plane.width + x)];
      const double relative = (value - view.darkest) / (view.brightest - view.darkest);
      const double grey = std::isfinite(relative) ? std::clamp(relative, 0.0, 1.0) : 0.0;
      const auto level = static_cast<std::uint8_t>(std::lround(255 * brightness * grey));
      canvas.at(x, y) = {level, level, level};
    }
  }
}

void draw_orientation(Canvas& canvas, const SlicePlane& plane) {
  const double w = plane.width;
  const double h = plane.height;
  const Vector2d places[] = {{14, h / 2}, {w - 14, h / 2}, {w / 2, 14}, {w / 2, h - 14}};
  for (std::size_t side = 0; side < 4; ++side) {
    draw_text(canvas, places[side], std::string(1, plane.letters[side]),
              {.size = 19, .fill = colour::white, .anchor = Anchor::centre, .bold = true, .halo = true});
  }
  const double length = 20 * plane.scale;
  draw_line(canvas, {w - 14 - length, h - 16}, {w - 14, h - 16}, 3, colour::white);
  draw_text(canvas, {w - 14 - length / 2, h - 30}, "20 mm",
            {.size = 14, .fill = colour::white, .anchor = Anchor::centre, .halo = true});
}

void draw_title(Canvas& canvas, const std::string& title) {
  draw_text(canvas, {10, 16}, title, {.size = 17, .fill = colour::white, .bold = true, .halo = true});
}

bool in_opening(const View& view, const Vector3d& place) {
  return view.opening.rows() > 0 &&
         (view.opening.rowwise() - place.transpose()).rowwise().norm().minCoeff() < view.opening_reach;
}

void draw_outline(Canvas& canvas, const std::vector<CutSegment>& outline, const Colour& stroke) {
  for (const auto& segment : outline) {
    draw_line(canvas, segment.from, segment.to, 1.2, stroke);
  }
}

void draw_opening(Canvas& canvas, const View& view, const SlicePlane& plane, const std::vector<CutSegment>& outline) {
  for (const auto& segment : outline) {
    if (in_opening(view, plane.world(0.5 * (segment.from + segment.to)))) {
      draw_line(canvas, segment.from, segment.to, 4, opening_colour);
    }
  }
}

Figure before_figure(const View& view, const SlicePlane& plane, const std::vector<float>& values,
                     const std::vector<CutSegment>& outline) {
  Canvas canvas(plane.width, plane.height, colour::black);
  draw_grey(canvas, view, plane, values, 1);
  draw_outline(canvas, outline, preop_colour);
  draw_opening(canvas, view, plane, outline);
  draw_title(canvas, "before");
  draw_orientation(canvas, plane);
  return {plane.name + "_before", "Preoperative image, " + plane.name + " slice", std::move(canvas)};
}

Figure after_figure(const View& view, const SlicePlane& plane, const std::vector<float>& values,
                    const std::vector<CutSegment>& outline) {
  Canvas canvas(plane.width, plane.height, colour::black);
  draw_grey(canvas, view, plane, values, 1);
  draw_outline(canvas, outline, preop_colour);
  draw_outline(canvas, cut_surface(plane, view.deformed), intraop_colour);
  draw_title(canvas, "after");
  draw_orientation(canvas, plane);
  return {plane.name + "_after", "Image warped to the intraoperative brain, " + plane.name + " slice",
          std::move(canvas)};
}

Figure difference_figure(const View& view, const SlicePlane& plane, const std::vector<float>& before,
                         const std::vector<float>& after) {
  const double reach = 0.5 * (view.brightest - view.darkest);
  const ColourScale scale{.map = ColourMap::diverging, .low = -100, .high = 100, .title = "% of range"};
  Canvas canvas(plane.width + bar_width, plane.height, colour::black);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      const auto i = static_cast<std::size_t>(y * plane.width + x);
      const double change = static_cast<double>(after[i]) - static_cast<double>(before[i]);
      canvas.at(x, y) = scale.colour_of(std::isfinite(change) ? 50 * change / reach : 0);
    }
  }
  draw_colour_bar(canvas, scale, plane.width + 8, 70, plane.height - 140, colour::white);
  draw_title(canvas, "after - before");
  draw_orientation(canvas, plane);
  return {plane.name + "_difference", "Brightness after minus before, " + plane.name + " slice", std::move(canvas)};
}

// Displacements of the pixels that the mask selects, in its order.
Points displacement_of_pixels(const RunData& run, const SlicePlane& plane, const std::vector<std::uint8_t>& mask) {
  Points places(std::ranges::count(mask, 1), 3);
  Eigen::Index row = 0;
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (mask[static_cast<std::size_t>(y * plane.width + x)] == 1) {
        places.row(row++) = plane.world({x + 0.5, y + 0.5}).transpose();
      }
    }
  }
  if (!run.forward) {
    return displacement_at(*run.solution, places);
  }
  for (auto place : places.rowwise()) {
    place = sample_field(*run.forward, place.transpose()).transpose().eval();
  }
  return places;
}

// Where nothing moves the image is seen as it is.
double opacity(const View& view, double shift, bool over_image) {
  return over_image ? 0.7 * std::min(1.0, 5 * shift / view.shift.high) : 0.9;
}

void draw_shift_arrow(Canvas& canvas, const SlicePlane& plane, const Vector2d& from, const Vector2d& in_plane) {
  const Vector2d to = from + plane.scale * in_plane;
  if ((to - from).norm() < 2) {
    return;
  }
  draw_arrow(canvas, from, to, 2.6, {20, 20, 24});
  draw_arrow(canvas, from, to, 1.4, colour::white);
}

}  // namespace

std::vector<Figure> comparison_figures(const RunData& run, const View& view, const SlicePlane& plane) {
  const auto before = sample_slice(plane, *run.t1);
  const auto after = sample_slice(plane, *run.warped);
  const auto outline = cut_surface(plane, *run.brain);
  std::vector<Figure> figures;
  figures.push_back(before_figure(view, plane, before, outline));
  figures.push_back(after_figure(view, plane, after, outline));
  figures.push_back(difference_figure(view, plane, before, after));
  return figures;
}

double arrow_factor(const View& view) {
  const double wanted = 18 / std::max(view.shift.high, 1e-6);
  for (const double factor : {10.0, 5.0, 4.0, 3.0, 2.0}) {
    if (factor <= wanted) {
      return factor;
    }
  }
  return 1;
}

Figure displacement_figure(const RunData& run, const View& view, const SlicePlane& plane) {
  constexpr int arrow_distance = 22;  // pixels
  Canvas canvas(plane.width + bar_width, plane.height, colour::black);
  if (run.t1) {
    draw_grey(canvas, view, plane, sample_slice(plane, *run.t1), 0.85);
  }
  const auto outline = cut_surface(plane, *run.brain);
  const auto mask = inside_mask(plane, outline);
  const Points shift = displacement_of_pixels(run, plane, mask);
  std::vector<std::pair<Vector2d, Vector2d>> arrows;
  Eigen::Index row = 0;
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (mask[static_cast<std::size_t>(y * plane.width + x)] == 0) {
        continue;
      }
      const Vector3d u = shift.row(row++);
      canvas.at(x, y) =
          blend(canvas.at(x, y), view.shift.colour_of(u.norm()), opacity(view, u.norm(), run.t1.has_value()));
      if (x % arrow_distance == arrow_distance / 2 && y % arrow_distance == arrow_distance / 2) {
        arrows.push_back({{x + 0.5, y + 0.5}, arrow_factor(view) * Vector2d(u.dot(plane.right), u.dot(plane.down))});
      }
    }
  }
  draw_outline(canvas, outline, preop_colour);
  draw_opening(canvas, view, plane, outline);
  for (const auto& [from, in_plane] : arrows) {
    draw_shift_arrow(canvas, plane, from, in_plane);
  }
  draw_colour_bar(canvas, view.shift, plane.width + 8, 70, plane.height - 140, colour::white);
  draw_title(canvas, plane.name);
  draw_orientation(canvas, plane);
  return {plane.name + "_displacement", "Displacement as colours and arrows, " + plane.name + " slice",
          std::move(canvas)};
}

}  // namespace brainshift::pipelines
