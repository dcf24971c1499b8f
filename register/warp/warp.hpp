// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "register/interface/options.hpp"
#include "segmentation/geometry/points.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// Points (landmarks, surface vertices) moved with a forward field, linear interpolation; zero displacement outside the
/// image; a point on the outermost half voxel is inside.
Points move_points(const VectorImage& forward, const Points& points);

/// An image or label map on any grid, resampled on its own grid with the resampling field: linear or cubic B-spline,
/// labels by the nearest voxel. A voxel that does not move keeps its value bit for bit; 0 comes in from outside the
/// image. Throws std::invalid_argument when an image has fewer than four voxels along an axis and B-splines are wanted.
ScalarImage warp(const ScalarImage& image, const VectorImage& resampling, Interpolation interpolation);
LabelMap warp(const LabelMap& labels, const VectorImage& resampling);

/// The same on another grid, where every voxel is interpolated.
ScalarImage warp(const ScalarImage& image, const VectorImage& resampling, Interpolation interpolation,
                 const ImageGeometry& grid);
LabelMap warp(const LabelMap& labels, const VectorImage& resampling, const ImageGeometry& grid);

}  // namespace brainshift::registration
