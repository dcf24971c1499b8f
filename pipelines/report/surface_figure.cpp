// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/surface_figure.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "pipelines/report/rasteriser.hpp"

namespace brainshift::pipelines {

namespace {

using Eigen::Vector3d;

constexpr int half_width = 520;  // of the final picture: one of the two views
constexpr int height = 500;

// The rim of the opening on the surface: where the distance to the nearest loaded node is the opening's reach. Pairs
// of points, one pair a triangle that it crosses.
Points opening_rim(const Surface& preop, const Surface& shown, const View& view) {
  std::vector<double> distance;
  for (const auto& vertex : preop.vertices.rowwise()) {
    distance.push_back((view.opening.rowwise() - vertex).rowwise().norm().minCoeff() - view.opening_reach);
  }
  std::vector<Vector3d> ends;
  for (const auto& triangle : preop.triangles.rowwise()) {
    for (int edge = 0; edge < 3; ++edge) {
      const auto a = static_cast<std::size_t>(triangle[edge]);
      const auto b = static_cast<std::size_t>(triangle[(edge + 1) % 3]);
      if ((distance[a] < 0) != (distance[b] < 0)) {
        const Vector3d from = shown.vertices.row(triangle[edge]);
        const Vector3d to = shown.vertices.row(triangle[(edge + 1) % 3]);
        ends.push_back(from + (to - from) * (distance[a] / (distance[a] - distance[b])));
      }
    }
  }
  Points rim(static_cast<Eigen::Index>(ends.size()), 3);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    rim.row(static_cast<Eigen::Index>(i)) = ends[i].transpose();
  }
  return rim;
}

// Where left, posterior and superior point.
void draw_axes(Svg& svg, const Camera& camera, const Eigen::Vector2d& middle) {
  const char* names[] = {"L", "P", "S"};
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d end = camera.project(camera.target + Vector3d::Unit(axis)) - camera.project(camera.target);
    const Eigen::Vector2d direction = end.head<2>() / camera.scale;
    if (direction.norm() < 0.1) {
      continue;
    }
    svg.lines(arrow(middle, middle + 34 * direction, 2), {.width = 2});
    svg.text(middle + (34 * direction.norm() + 12) * direction.normalized(), names[axis],
             {.size = 15, .anchor = Anchor::centre, .bold = true});
  }
}

void draw_view(Svg& svg, const Eigen::Vector2d& corner, const RunData& run, const View& view, const Vector3d& towards,
               const std::string& title) {
  const Points& vertices = view.deformed.vertices;
  const Vector3d low = vertices.colwise().minCoeff();
  const Vector3d high = vertices.colwise().maxCoeff();
  const double reach = (vertices.rowwise() - (0.5 * (low + high)).transpose()).rowwise().norm().maxCoeff();
  const Camera camera = look_at(0.5 * (low + high), towards, 0.5 * (height - 40) / reach, half_width, height);
  const DepthCanvas picture = draw_surface(camera, view.deformed, view.surface_shift, view.shift);
  svg.image(picture.canvas, corner);
  if (view.opening.rows() > 0) {
    const Points rim = opening_rim(*run.brain, view.deformed, view);
    std::vector<Segment> lines;
    for (Eigen::Index i = 0; i + 1 < rim.rows(); i += 2) {
      for (const Segment& part : visible_parts(picture, camera, rim.middleRows(i, 2))) {
        lines.push_back({part.from + corner, part.to + corner});
      }
    }
    svg.lines(lines, {.colour = {20, 60, 160}, .width = 2});
  }
  draw_axes(svg, camera, corner + Eigen::Vector2d(64, height - 70));
  svg.text(corner + Eigen::Vector2d(16, 20), title, {.size = 17, .bold = true});
}

}  // namespace

Figure surface_figure(const RunData& run, const View& view) {
  constexpr int bar = 120, width = 2 * half_width + bar;
  const std::string name = "surface";
  Svg svg(name, "The brain's surface, coloured by displacement", width, height);
  svg.rectangle({0, 0}, {width, height}, colour::white);
  const Vector3d sideways = (Vector3d::UnitZ() - view.inward.z() * view.inward).cross(view.inward);
  const Vector3d side = sideways.norm() > 0.1 ? sideways.normalized() : view.inward.unitOrthogonal();
  const bool opened = view.opening.rows() > 0;
  draw_view(svg, {0, 0}, run, view, view.inward, opened ? "seen through the opening" : "from above");
  draw_view(svg, {half_width, 0}, run, view, (0.5 * view.inward + 0.9 * side).normalized(), "from the side");
  draw_colour_bar(svg, view.shift, {2 * half_width + 16, 80}, height - 160, colour::ink);
  return {.name = name, .width = width, .height = height, .svg = std::move(svg).str()};
}

}  // namespace brainshift::pipelines
