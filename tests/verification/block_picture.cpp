// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/verification/block_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "pipelines/report/rasteriser.hpp"
#include "solve/output/field_difference.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification {

namespace {

using Eigen::Vector3d;

constexpr int divisions = 30;      // of a side
constexpr int every = 5;           // of them a line is drawn
constexpr double off_face = 1e-3;  // mm: which face of the cut a place belongs to
constexpr int picture_width = 820, picture_height = 620, bar = 110;

/// A side of the block: a grid of places with vertices of its own, so that the block's edges are sharp.
struct Side {
  Vector3d corner, first, second;  ///< outward: first × second
  Points places() const {
    Points rows((divisions + 1) * (divisions + 1), 3);
    for (int j = 0; j <= divisions; ++j) {
      for (int i = 0; i <= divisions; ++i) {
        rows.row(j * (divisions + 1) + i) = corner + (i * first + j * second) / divisions;
      }
    }
    return rows;
  }
};

/// The sides of the half above or below the cut, with its face of the cut.
std::vector<Side> sides_of_half(const Vector3d& size, double front, bool above) {
  const double low = above ? size.z() / 2 + off_face : 0, high = above ? size.z() : size.z() / 2 - off_face;
  const Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, high - low), from(0, 0, low), cut(front, 0, 0);
  const Side face = above ? Side{from, y, cut} : Side{from + z, cut, y};
  const Side end = above ? Side{from + z, x, y} : Side{from, y, x};
  return {face, end, {from, x, z}, {from + y, z, x}, {from, z, y}, {from + x, y, z}};
}

Triangles grid_triangles() {
  Triangles triangles(2 * divisions * divisions, 3);
  for (int j = 0; j < divisions; ++j) {
    for (int i = 0; i < divisions; ++i) {
      const int a = j * (divisions + 1) + i, row = 2 * (j * divisions + i);
      triangles.row(row) << a, a + 1, a + divisions + 2;
      triangles.row(row + 1) << a, a + divisions + 2, a + divisions + 1;
    }
  }
  return triangles;
}

/// All sides as they are deformed, one after the other.
struct DeformedBlock {
  Surface surface;
  std::vector<double> shift;  ///< of each vertex, mm
};

DeformedBlock deformed(const Solution& solution, const std::vector<Side>& sides) {
  const Triangles grid = grid_triangles();
  constexpr Eigen::Index vertices = (divisions + 1) * (divisions + 1);
  const auto count = static_cast<Eigen::Index>(sides.size());
  Points places(count * vertices, 3);
  DeformedBlock block;
  block.surface.triangles.resize(count * grid.rows(), 3);
  for (Eigen::Index s = 0; s < count; ++s) {
    places.middleRows(s * vertices, vertices) = sides[static_cast<std::size_t>(s)].places();
    block.surface.triangles.middleRows(s * grid.rows(), grid.rows()) =
        grid.array() + static_cast<std::int32_t>(s * vertices);
  }
  const Points u = displacement_at(solution, places);
  block.surface.vertices = places + u;
  const Eigen::VectorXd norms = u.rowwise().norm();
  block.shift.assign(norms.begin(), norms.end());
  return block;
}

std::vector<pipelines::Segment> visible_grid(const pipelines::DepthCanvas& picture, const pipelines::Camera& camera,
                                             const Points& vertices) {
  std::vector<pipelines::Segment> grid;
  constexpr int across = divisions + 1;
  for (Eigen::Index side = 0; side < vertices.rows(); side += across * across) {
    for (int k = 0; k <= divisions; k += every) {
      Points row(across, 3), column(across, 3);
      for (int i = 0; i < across; ++i) {
        row.row(i) = vertices.row(side + k * across + i);
        column.row(i) = vertices.row(side + i * across + k);
      }
      for (const Points& line : {row, column}) {
        const std::vector<pipelines::Segment> parts = visible_parts(picture, camera, line);
        grid.insert(grid.end(), parts.begin(), parts.end());
      }
    }
  }
  return grid;
}

}  // namespace

std::string picture_of_cut_block(const Solution& solution, const Vector3d& size, double front) {
  std::vector<Side> sides = sides_of_half(size, front, false);
  const std::vector<Side> upper = sides_of_half(size, front, true);
  sides.insert(sides.end(), upper.begin(), upper.end());
  const DeformedBlock block = deformed(solution, sides);
  const Points& vertices = block.surface.vertices;
  const Vector3d low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
  const double scale = 1.03 * picture_height / (high - low).norm();
  const Vector3d towards = Vector3d(1, 0.8, -0.35).normalized();
  const pipelines::Camera camera = pipelines::look_at((low + high) / 2, towards, scale, picture_width, picture_height);
  const double largest = *std::max_element(block.shift.begin(), block.shift.end());
  const pipelines::ColourScale colours{.high = pipelines::round_up(largest), .title = "shift, mm"};
  const pipelines::DepthCanvas picture = draw_surface(camera, block.surface, block.shift, colours);
  pipelines::Svg svg("cut_block", "A block that is cut in its middle, coloured by displacement", picture_width + bar,
                     picture_height);
  svg.rectangle({0, 0}, {picture_width + bar, picture_height}, pipelines::colour::white);
  svg.image(picture.canvas, {0, 0});
  svg.lines(visible_grid(picture, camera, vertices), {.colour = {70, 70, 70}, .width = 1});
  draw_colour_bar(svg, colours, {picture_width + 8, 80}, picture_height - 160, pipelines::colour::ink);
  return std::move(svg).str();
}

}  // namespace brainshift::verification
