// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "discretise/body/scanlines.hpp"
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

  std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
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

/// Where a surface cuts the plane, in pixels; one segment a triangle, which is all that a picture needs.
std::vector<Segment> cut_surface(const SlicePlane& plane, const Surface& surface);

/// The numbers of the plane's pixels, row by row, whose centres lie in a body, ascending.
std::vector<std::size_t> pixels_inside(const SlicePlane& plane, const discretise::Scanlines& body);

/// The centre of a pixel, by its number.
Eigen::Vector3d centre_of(const SlicePlane& plane, std::size_t pixel);

/// An image in the plane, one value a pixel, linear between voxels; NaN outside the image.
std::vector<float> sample_slice(const SlicePlane& plane, const ScalarImage& image);

}  // namespace brainshift::pipelines
