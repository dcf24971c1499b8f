// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/cylinder.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "pipelines/runner/stage_folder.hpp"
#include "segmentation/files/make_folder.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/geometry/surface.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::pipelines {

namespace {

constexpr double full_radius = 50, full_height = 100, pressed = 10;  // mm
constexpr int around = 120;                                          // vertices on a rim: an edge of 2.6 mm

Eigen::RowVector3d on_circle(double r, int i, int count, double z) {
  const double angle = 2 * std::numbers::pi * i / count;
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Rows of vertices on circles from the middle of the bottom over the side to the middle of the top.
struct Circle {
  double radius, z;
};

std::vector<Circle> circles() {
  constexpr int rings = 20, rows = 40;
  std::vector<Circle> all;
  for (int i = 1; i <= rings; ++i) {
    all.push_back({full_radius * i / rings, 0});
  }
  for (int i = 1; i <= rows; ++i) {
    all.push_back({full_radius, full_height * i / rows});
  }
  for (int i = rings - 1; i >= 1; --i) {
    all.push_back({full_radius * i / rings, full_height});
  }
  return all;
}

Surface cylinder() {
  const std::vector<Circle> rows = circles();
  const auto count = static_cast<int>(rows.size());
  Surface surface;
  surface.vertices.resize(around * count + 2, 3);
  surface.triangles.resize(2 * around * count, 3);
  const std::int32_t bottom = around * count, top = bottom + 1;
  surface.vertices.row(bottom) << 0, 0, 0;
  surface.vertices.row(top) << 0, 0, full_height;
  Eigen::Index t = 0;
  for (int row = 0; row < count; ++row) {
    const Circle& circle = rows[static_cast<std::size_t>(row)];
    for (int i = 0; i < around; ++i) {
      const int here = row * around + i, beside = row * around + (i + 1) % around;
      surface.vertices.row(here) = on_circle(circle.radius, i, around, circle.z);
      if (row == 0) {
        surface.triangles.row(t++) << bottom, beside, here;
      }
      if (row + 1 < count) {
        surface.triangles.row(t++) << here, beside, beside + around;
        surface.triangles.row(t++) << here, beside + around, here + around;
      } else {
        surface.triangles.row(t++) << top, here, beside;
      }
    }
  }
  return surface;
}

/// A box whose floor the cylinder stands on and whose walls it never reaches.
Surface plate() {
  constexpr double wide = 1.4 * full_radius, high = 1.1 * full_height;
  Surface box{Points(8, 3), Triangles(12, 3)};
  for (int corner = 0; corner < 8; ++corner) {
    box.vertices.row(corner) << (corner & 1 ? wide : -wide), (corner & 2 ? wide : -wide), (corner & 4 ? high : 0);
  }
  box.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3,
      7, 5;
  return box;
}

solve::CraniotomyLoad pressed_top() {
  std::vector<Eigen::RowVector3d> places = {{0, 0, full_height}};
  for (const double r : {full_radius / 3, 2 * full_radius / 3, full_radius}) {
    for (int i = 0; i < 60; ++i) {
      places.push_back(on_circle(r, i, 60, full_height));
    }
  }
  const auto count = static_cast<Eigen::Index>(places.size());
  solve::CraniotomyLoad load{Points(count, 3), Points::Zero(count, 3)};
  for (Eigen::Index i = 0; i < count; ++i) {
    load.positions.row(i) = places[static_cast<std::size_t>(i)];
  }
  load.displacement.col(2).setConstant(-pressed);
  return load;
}

constexpr const char* scene = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- A soft cylinder on a smooth plate; its top is pressed down by a tenth of its height and does not widen. -->
<scene version="1">
  <image surface="cylinder.vtp"/>
  <tissues>
    <tissue label="1" name="gel" youngs_modulus="3000" poisson_ratio="0.49" density="1000"/>
  </tissues>
  <!-- depth: nodes of the side are not loaded -->
  <load depth="0.01">
    <craniotomy file="craniotomy.csv"/>
  </load>
  <contact skull="plate.vtp"/>
  <stage name="discretise" nodes="6000"/>
</scene>
)";

}  // namespace

void write_cylinder(const std::filesystem::path& out) {
  make_folder(out);
  write_surface(out / "cylinder.vtp", cylinder());
  write_surface(out / "plate.vtp", plate());
  solve::write_craniotomy_csv(out / "craniotomy.csv", pressed_top());
  write_whole(out / "scene.xml", scene);
}

}  // namespace brainshift::pipelines
