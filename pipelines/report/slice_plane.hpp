// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/report/svg.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::pipelines {

/// An anatomical plane of the world (LPS), whatever the image's own axes are, and the picture that shows it: pixel
/// (x, y) lies at corner + right · x / scale + down · y / scale.
struct SlicePlane {
  std::string name;  ///< axial, coronal, sagittal
  int normal_axis;   ///< world axis that the plane cuts
  Eigen::Vector3d corner;
  Eigen::Vector3d right;
  Eigen::Vector3d down;
  int width;                    ///< pixels
  int height;                   ///< pixels
  double scale;                 ///< pixels a mm
  std::array<char, 4> letters;  ///< at the left, right, upper and lower border

  Eigen::Vector3d world(const Eigen::Vector2d& pixel) const {
    return corner + (right * pixel.x() + down * pixel.y()) / scale;
  }
  Eigen::Vector2d pixel(const Eigen::Vector3d& world) const {
    return scale * Eigen::Vector2d((world - corner).dot(right), (world - corner).dot(down));
  }
};

/// Axial, coronal and sagittal planes through a point, as radiologists look at them (the patient's left on the right;
/// anterior to the left in the sagittal one). They show the box from low to high.
std::array<SlicePlane, 3> anatomical_planes(const Eigen::Vector3d& through, const Eigen::Vector3d& low,
                                            const Eigen::Vector3d& high, double scale);

/// Where a surface cuts the plane, in pixels; one segment a triangle, which is all that a picture and the mask need.
std::vector<Segment> cut_surface(const SlicePlane& plane, const Surface& surface);

/// One value a pixel, row by row: 1 inside the closed surface that made the segments (even-odd rule).
std::vector<std::uint8_t> inside_mask(const SlicePlane& plane, const std::vector<Segment>& segments);

/// An image in the plane, one value a pixel, linear between voxels; NaN outside the image.
std::vector<float> sample_slice(const SlicePlane& plane, const ScalarImage& image);

}  // namespace brainshift::pipelines
