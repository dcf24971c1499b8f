// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipelines/report/canvas.hpp"
#include "pipelines/report/colour_scale.hpp"
#include "pipelines/report/svg.hpp"
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

/// A picture with the depth of what is drawn in it.
struct DepthCanvas {
  Canvas canvas;
  std::vector<double> depth;  ///< mm, `sampling` × `sampling` values a pixel; infinite where nothing is drawn
  static constexpr int sampling = 2;
};

/// Draws a surface, one value a vertex as its colour, shaded by smooth normals with the light at the camera's shoulder,
/// with soft edges. What is hidden is not seen (z-buffer). By hand because VTK's renderer needs OpenGL, thus a display
/// or a driver, and SVG knows no depth.
DepthCanvas draw_surface(const Camera& camera, const Surface& surface, const std::vector<double>& values,
                         const ColourScale& scale);

/// The parts of a line in space that the surface does not hide, in the picture; points up to 2 mm behind the surface
/// are on it.
std::vector<Segment> visible_parts(const DepthCanvas& picture, const Camera& camera, const Points& line);

}  // namespace brainshift::pipelines
