// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipelines/report/canvas.hpp"
#include "pipelines/report/colour_scale.hpp"
#include "segmentation/geometry/surface.hpp"

namespace brainshift::pipelines {

/// An orthographic camera: where a point lies in the picture (pixels) and how far behind the picture's plane (mm).
struct Camera {
  Eigen::Vector3d target;   ///< shown in the middle
  Eigen::Vector3d towards;  ///< unit vector from the camera to the target
  Eigen::Vector3d up;       ///< unit vector, at right angles to `towards`
  double scale;             ///< pixels a mm
  int width;
  int height;

  Eigen::Vector3d project(const Eigen::Vector3d& world) const;  ///< x, y in pixels; z the depth, mm
};

/// Looks at a point; `up` is the patient's superior direction, or anterior where one looks along it.
Camera look_at(const Eigen::Vector3d& target, const Eigen::Vector3d& towards, double scale, int width, int height);

/// A picture with the depth of what is drawn in each pixel.
struct DepthCanvas {
  Canvas canvas;
  std::vector<double> depth;  ///< mm, infinite where nothing is drawn
};

/// Draws a surface, one value a vertex as its colour, shaded by smooth normals with the light at the camera's shoulder.
/// What is hidden is not seen (z-buffer).
DepthCanvas draw_surface(const Camera& camera, const Surface& surface, const std::vector<double>& values,
                         const ColourScale& scale);

/// Draws a line in space where the surface does not hide it; points up to 2 mm behind the surface are on it.
void draw_line_on(DepthCanvas& picture, const Camera& camera, const Points& line, double width, const Colour& stroke);

/// Half the size, every pixel the mean of four: soft edges.
Canvas halve(const Canvas& canvas);

}  // namespace brainshift::pipelines
