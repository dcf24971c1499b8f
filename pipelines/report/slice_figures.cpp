// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/slice_figures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "register/field/nodal_values.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/labels/label_table.hpp"

namespace brainshift::pipelines {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Colour preop_colour = {90, 200, 250};
constexpr Colour intraop_colour = {255, 150, 60};
constexpr Colour opening_colour = {70, 235, 110};
constexpr Colour septum_colour = {210, 130, 255};
constexpr int bar_width = 96;  // pixels to the right of a picture with a colour bar

// Grey as radiologists see it; where the image has no value, or there is none, black.
Canvas grey(const View& view, const SlicePlane& plane, const std::vector<float>& values, double brightness = 1) {
  Canvas canvas(plane.width, plane.height, colour::black);
  std::ranges::transform(values, canvas.pixels.begin(), [&](float value) {
    const double relative = (static_cast<double>(value) - view.darkest) / (view.brightest - view.darkest);
    const double shade = std::isfinite(relative) ? std::clamp(relative, 0.0, 1.0) : 0.0;
    const auto level = static_cast<std::uint8_t>(std::lround(255 * brightness * shade));
    return Colour{level, level, level};
  });
  return canvas;
}

// A picture that shows a plane: its pixels, to be lined and lettered, and room for a colour bar where one is wanted.
struct Sheet {
  const SlicePlane& plane;
  std::string name;
  int width;
  Svg svg;

  Sheet(const SlicePlane& plane_, const std::string& what, const std::string& label, const Canvas& pixels, int bar)
      : plane(plane_),
        name(plane_.name + "_" + what),
        width(plane_.width + bar),
        svg(name, label + ", " + plane_.name + " slice", width, plane_.height) {
    svg.rectangle({0, 0}, {width, plane.height}, colour::black);
    svg.image(pixels, {0, 0});
  }
};

void draw_colours(Sheet& sheet, const ColourScale& scale) {
  draw_colour_bar(sheet.svg, scale, {sheet.plane.width + 8, 70}, sheet.plane.height - 140, colour::white);
}

// The sides of the patient, a scale and the title: the last that is drawn.
Figure lettered(Sheet sheet, const std::string& title) {
  const SlicePlane& plane = sheet.plane;
  const double w = plane.width;
  const double h = plane.height;
  const Vector2d places[] = {{14, h / 2}, {w - 14, h / 2}, {w / 2, 14}, {w / 2, h - 14}};
  for (std::size_t side = 0; side < 4; ++side) {
    sheet.svg.text(places[side], std::string(1, plane.letters[side]),
                   {.size = 19, .fill = colour::white, .anchor = Anchor::centre, .bold = true, .halo = true});
  }
  const double length = 20 * plane.scale;
  sheet.svg.line({w - 14 - length, h - 16}, {w - 14, h - 16}, {.colour = colour::white, .width = 3});
  sheet.svg.text({w - 14 - length / 2, h - 30}, "20 mm",
                 {.fill = colour::white, .anchor = Anchor::centre, .halo = true});
  sheet.svg.text({10, 16}, title, {.size = 17, .fill = colour::white, .bold = true, .halo = true});
  return {.name = sheet.name, .width = sheet.width, .height = plane.height, .svg = std::move(sheet.svg).str()};
}

// What closing took in, as a label of the picture; no map holds it.
constexpr std::int32_t taken_in = -1;

// Far apart for labels that are near each other. Each round is darker.
std::map<std::int32_t, Colour> colours_of_labels(const LabelMap& labels) {
  constexpr Colour colours[] = {{240, 200, 90},  {80, 140, 255},  {230, 70, 70},  {90, 220, 220},
                                {245, 245, 245}, {200, 140, 110}, {130, 210, 90}, {150, 150, 150}};
  std::map<std::int32_t, Colour> of = {{taken_in, {255, 60, 220}}};
  for (std::size_t place = 0; const auto& [label, volume] : segmentation::label_volumes(labels)) {
    const double share = std::max(0.4, std::pow(0.8, static_cast<double>(place / std::size(colours))));
    of[label] = blend(colour::black, colours[place % std::size(colours)], share);
    ++place;
  }
  return of;
}

bool in_opening(const View& view, const Vector3d& place) {
  return view.opening.rows() > 0 &&
         (view.opening.rowwise() - place.transpose()).rowwise().norm().minCoeff() < view.opening_reach;
}

void draw_outline(Sheet& sheet, const std::vector<Segment>& outline, const Colour& colour) {
  sheet.svg.lines(outline, {.colour = colour, .width = 1.2});
}

// The brain's surface before, and the part of it that lies in the opening.
void draw_before(Sheet& sheet, const View& view, const Slice& slice) {
  std::vector<Segment> opening;
  std::ranges::copy_if(slice.outline, std::back_inserter(opening), [&](const Segment& segment) {
    return in_opening(view, slice.plane.world(0.5 * (segment.from + segment.to)));
  });
  draw_outline(sheet, slice.outline, preop_colour);
  sheet.svg.lines(opening, {.colour = opening_colour, .width = 4});
}

Figure difference_figure(const View& view, const SlicePlane& plane, const std::vector<float>& before,
                         const std::vector<float>& after) {
  const double reach = 0.5 * (view.brightest - view.darkest);
  const ColourScale scale{.map = ColourMap::diverging, .low = -100, .high = 100, .title = "% of range"};
  Canvas canvas(plane.width, plane.height, colour::black);
  std::ranges::transform(after, before, canvas.pixels.begin(), [&](double to, double from) {
    return scale.colour_of(std::isfinite(to - from) ? 50 * (to - from) / reach : 0);
  });
  Sheet sheet(plane, "difference", "Brightness after minus before", canvas, bar_width);
  draw_colours(sheet, scale);
  return lettered(std::move(sheet), "after - before");
}

Points places_inside(const Slice& slice) {
  Points places(static_cast<Eigen::Index>(slice.inside.size()), 3);
  for (Eigen::Index i = 0; const std::size_t pixel : slice.inside) {
    places.row(i++) = centre_of(slice.plane, pixel).transpose();
  }
  return places;
}

// Of a field in the brain, over the T1: colours and their opacities, each by the value's place among those of
// slice.inside.
template <class ColourAt, class Opacity>
Canvas coloured(const View& view, const Slice& slice, const ColourAt& colour_at, const Opacity& opacity) {
  Canvas canvas = grey(view, slice.plane, slice.t1, 0.85);
  for (Eigen::Index i = 0; const std::size_t pixel : slice.inside) {
    canvas.pixels[pixel] = blend(canvas.pixels[pixel], colour_at(i), slice.t1.empty() ? 0.9 : opacity(i));
    ++i;
  }
  return canvas;
}

// A point a square of 22 pixels.
std::vector<Segment> arrows_of(const View& view, const Slice& slice, const Points& shift) {
  constexpr std::size_t distance = 22;
  const SlicePlane& plane = slice.plane;
  std::vector<Segment> arrows;
  for (Eigen::Index i = 0; const std::size_t pixel : slice.inside) {
    const Vector3d u = shift.row(i++);
    const std::size_t x = pixel % static_cast<std::size_t>(plane.width);
    const std::size_t y = pixel / static_cast<std::size_t>(plane.width);
    if (x % distance == distance / 2 && y % distance == distance / 2) {
      const Vector2d from = plane.pixel(centre_of(plane, pixel));
      arrows.push_back(
          {from, from + plane.scale * arrow_factor(view) * Vector2d(u.dot(plane.right), u.dot(plane.down))});
    }
  }
  return arrows;
}

// White on a dark seam.
void draw_arrows(Svg& svg, const std::vector<Segment>& shifts) {
  const Stroke white{.colour = colour::white, .width = 1.4};
  std::vector<Segment> lines;
  for (const auto& [from, to] : shifts) {
    if ((to - from).norm() >= 2) {
      std::ranges::copy(arrow(from, to, white.width), std::back_inserter(lines));
    }
  }
  svg.lines(lines, {.colour = {20, 20, 24}, .width = white.width + 1.2});
  svg.lines(lines, white);
}

// The tissue, where the run knows what the numbers are.
std::string name_of_label(const nlohmann::json& record, std::int32_t label) {
  const std::string number = std::to_string(label);
  return record.value("label_names", nlohmann::json::object()).value(number, "label " + number);
}

}  // namespace

Points displacement_at(const RunData& run, const Points& places) {
  return run.forward ? registration::move_points(*run.forward, places) - places
                     : Points(registration::nodal_values_at(*run.solution, run.solution->displacement, false, places));
}

std::vector<Figure> comparison_figures(const RunData& run, const View& view, const Slice& slice) {
  const SlicePlane& plane = slice.plane;
  const auto warped = sample_slice(plane, *run.warped);
  Sheet before(plane, "before", "Preoperative image", grey(view, plane, slice.t1), 0);
  draw_before(before, view, slice);
  Sheet after(plane, "after", "Image warped to the intraoperative brain", grey(view, plane, warped), 0);
  draw_outline(after, slice.outline, preop_colour);
  draw_outline(after, cut_surface(plane, view.deformed), intraop_colour);
  std::vector<Figure> figures;
  figures.push_back(lettered(std::move(before), "before"));
  figures.push_back(lettered(std::move(after), "after"));
  figures.push_back(difference_figure(view, plane, slice.t1, warped));
  return figures;
}

Figure labels_figure(const RunData& run, const View& view, const Slice& slice) {
  const SlicePlane& plane = slice.plane;
  Canvas canvas = grey(view, plane, slice.t1);
  const double share = slice.t1.empty() ? 0.75 : 0.35;
  const std::map<std::int32_t, Colour> colours = colours_of_labels(*run.labels);
  std::set<std::int32_t> shown;
  for (std::size_t pixel = 0; pixel < canvas.pixels.size(); ++pixel) {
    const Vector3d place = centre_of(plane, pixel);
    const bool closed = run.closed && label_at(*run.closed, place) != 0;
    if (const std::int32_t label = closed ? taken_in : label_at(*run.labels, place); label != 0) {
      canvas.pixels[pixel] = blend(canvas.pixels[pixel], colours.at(label), share);
      shown.insert(label);
    }
  }
  Sheet sheet(plane, "labels", "Labels as they were understood", canvas, 0);
  draw_outline(sheet, slice.outline, preop_colour);
  double line = 40;
  for (const std::int32_t label : shown) {
    const std::string name = label == taken_in ? "taken in" : name_of_label(run.record, label);
    sheet.svg.rectangle({10, line - 6}, {12, 12}, colours.at(label));
    sheet.svg.text({28, line}, name, {.fill = colour::white, .halo = true});
    line += 18;
  }
  return lettered(std::move(sheet), plane.name);
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

Figure displacement_figure(const RunData& run, const View& view, const Slice& slice) {
  const Points shift = displacement_at(run, places_inside(slice));
  const Eigen::VectorXd length = shift.rowwise().norm();
  const Canvas canvas = coloured(
      view, slice, [&](auto i) { return view.shift.colour_of(length[i]); },
      [&](auto i) { return 0.7 * std::min(1.0, 5 * length[i] / view.shift.high); });  // what rests is seen as it is
  Sheet sheet(slice.plane, "displacement", "Displacement as colours and arrows", canvas, bar_width);
  draw_before(sheet, view, slice);
  if (run.septum) {
    sheet.svg.lines(cut_surface(slice.plane, *run.septum), {.colour = septum_colour, .width = 1.6});
  }
  draw_arrows(sheet.svg, arrows_of(view, slice, shift));
  draw_colours(sheet, view.shift);
  return lettered(std::move(sheet), slice.plane.name);
}

Figure uncertainty_figure(const RunData& run, const View& view, const Slice& slice) {
  const Eigen::Map<const Eigen::VectorXd> nodal(run.deviation.data(), static_cast<Eigen::Index>(run.deviation.size()));
  const Eigen::VectorXd deviation = registration::nodal_values_at(*run.solution, nodal, false, places_inside(slice));
  const ColourScale scale{
      .map = ColourMap::sequential, .low = 0, .high = round_up(nodal.maxCoeff()), .title = "+/- mm"};
  const Canvas canvas = coloured(
      view, slice, [&](auto i) { return scale.colour_of(deviation[i]); }, [](auto) { return 0.7; });
  Sheet sheet(slice.plane, "uncertainty", "How far the displacement may be off, as colours", canvas, bar_width);
  draw_before(sheet, view, slice);
  draw_colours(sheet, scale);
  return lettered(std::move(sheet), slice.plane.name + " +/-");
}

}  // namespace brainshift::pipelines
