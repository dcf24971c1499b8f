// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/rasteriser.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift::pipelines {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Colour shade(const Colour& base, const Vector3d& normal, const Camera& camera) {
  const Vector3d sideways = camera.towards.cross(camera.up);
  const Vector3d light = (-camera.towards - 0.45 * sideways + 0.55 * camera.up).normalized();
  const double facing = std::max(0.0, normal.dot(light));
  const double headlight = std::max(0.0, -normal.dot(camera.towards));
  const Vector3d halfway = (light - camera.towards).normalized();
  const double shine = 0.12 * std::pow(std::max(0.0, normal.dot(halfway)), 30);
  const double brightness = 0.34 + 0.46 * facing + 0.24 * headlight;
  Colour lit;
  for (std::size_t i = 0; i < 3; ++i) {
    lit[i] = static_cast<std::uint8_t>(std::lround(std::min(255.0, base[i] * brightness + 255 * shine)));
  }
  return lit;
}

// Calls set(x, y, barycentric weights) for the pixels of a triangle in the picture.
template <class Set>
void for_pixels(const Canvas& canvas, const Vector3d (&corner)[3], const Set& set) {
  const Vector2d a = corner[0].head<2>();
  const Vector2d b = corner[1].head<2>();
  const Vector2d c = corner[2].head<2>();
  const double area = cross(b - a, c - a);
  if (area == 0) {
    return;
  }
  const Vector2d low = a.cwiseMin(b).cwiseMin(c);
  const Vector2d high = a.cwiseMax(b).cwiseMax(c);
  const int x_end = std::min(canvas.width - 1, static_cast<int>(high.x()));
  const int y_end = std::min(canvas.height - 1, static_cast<int>(high.y()));
  for (int y = std::max(0, static_cast<int>(low.y())); y <= y_end; ++y) {
    for (int x = std::max(0, static_cast<int>(low.x())); x <= x_end; ++x) {
      const Vector2d p(x + 0.5, y + 0.5);
      const Vector3d weight(cross(b - p, c - p) / area, cross(c - p, a - p) / area, cross(a - p, b - p) / area);
      if (weight.minCoeff() >= 0) {
        set(x, y, weight);
      }
    }
  }
}

// Half the size, every pixel the mean of four: soft edges.
Canvas halved(const Canvas& canvas) {
  Canvas half(canvas.width / 2, canvas.height / 2, colour::white);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const int sum = canvas.at(2 * x, 2 * y)[channel] + canvas.at(2 * x + 1, 2 * y)[channel] +
                        canvas.at(2 * x, 2 * y + 1)[channel] + canvas.at(2 * x + 1, 2 * y + 1)[channel];
        half.at(x, y)[channel] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return half;
}

}  // namespace

Vector3d Camera::project(const Vector3d& world) const {
  const Vector3d from_target = world - target;
  const Vector3d right = towards.cross(up);
  return {width / 2.0 + scale * from_target.dot(right), height / 2.0 - scale * from_target.dot(up),
          from_target.dot(towards)};
}

Camera look_at(const Vector3d& target, const Vector3d& towards, double scale, int width, int height) {
  const Vector3d superior = Vector3d::UnitZ();
  const Vector3d anterior = -Vector3d::UnitY();
  const Vector3d wanted = std::abs(towards.dot(superior)) < 0.85 ? superior : anterior;
  const Vector3d up = (wanted - wanted.dot(towards) * towards).normalized();
  return {.target = target, .towards = towards, .up = up, .scale = scale, .width = width, .height = height};
}

DepthCanvas draw_surface(const Camera& camera, const Surface& surface, const std::vector<double>& values,
                         const ColourScale& scale) {
  constexpr int sampling = DepthCanvas::sampling;
  Canvas canvas(sampling * camera.width, sampling * camera.height, colour::white);
  std::vector<double> depth(canvas.pixels.size(), std::numeric_limits<double>::infinity());
  const Points normals = vertex_normals(surface).rowwise().normalized();
  for (const auto& triangle : surface.triangles.rowwise()) {
    Vector3d corner[3];
    Eigen::Matrix3d normal;
    Vector3d value;
    for (int i = 0; i < 3; ++i) {
      corner[i] = camera.project(surface.vertices.row(triangle[i]));
      corner[i].head<2>() *= sampling;
      normal.col(i) = normals.row(triangle[i]);
      value[i] = values[static_cast<std::size_t>(triangle[i])];
    }
    const Vector3d depths(corner[0].z(), corner[1].z(), corner[2].z());
    for_pixels(canvas, corner, [&](int x, int y, const Vector3d& weight) {
      double& nearest =
          depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas.width) + static_cast<std::size_t>(x)];
      if (weight.dot(depths) < nearest) {
        nearest = weight.dot(depths);
        canvas.at(x, y) = shade(scale.colour_of(weight.dot(value)), (normal * weight).normalized(), camera);
      }
    });
  }
  return {halved(canvas), std::move(depth)};
}

std::vector<Segment> visible_parts(const DepthCanvas& picture, const Camera& camera, const Points& line) {
  constexpr int sampling = DepthCanvas::sampling;
  const int width = sampling * camera.width, height = sampling * camera.height;
  std::vector<Segment> visible;
  for (Eigen::Index i = 0; i + 1 < line.rows(); ++i) {
    const Vector3d from = camera.project(line.row(i));
    const Vector3d to = camera.project(line.row(i + 1));
    const Vector3d middle = 0.5 * (from + to);
    const int x = std::clamp(static_cast<int>(sampling * middle.x()), 0, width - 1);
    const int y = std::clamp(static_cast<int>(sampling * middle.y()), 0, height - 1);
    const auto sample = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    if (middle.z() < picture.depth[sample] + 2) {
      visible.push_back({from.head<2>(), to.head<2>()});
    }
  }
  return visible;
}

}  // namespace brainshift::pipelines
