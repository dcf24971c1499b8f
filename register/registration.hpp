// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "segmentation/image/image.hpp"
#include "segmentation/progress.hpp"
#include "segmentation/surface/surface.hpp"
#include "solve/solution.hpp"

namespace brainshift::registration {

enum class Interpolation : std::uint8_t { linear, bspline };

struct RegisterOptions {
  double fade = 15.0;  ///< distance outside the brain over which the field goes to zero, mm
  Interpolation interpolation = Interpolation::linear;
  double inverse_tolerance = 0.01;  ///< of the fixed-point inversion, mm
};

struct RegisterInput {
  Solution solution;
  Surface brain;  ///< preop brain surface: outside it the field fades
  ScalarImage t1;
  std::optional<LabelMap> labels;
  Points landmarks = Points(0, 3);  ///< preop, mm LPS
};

struct RegisterMeasures {
  double inverse_mean = 0;  ///< over the brain's voxels: |x + forward + resampling(x + forward) - x|, mm
  double inverse_999 = 0;   ///< 99.9th percentile, mm
  double inverse_max = 0;
  double jacobian_min = 0;  ///< over the brain, of the forward map
  double jacobian_max = 0;
  double largest_displacement = 0;  ///< over the voxels, mm
  double fit_error = 0;             ///< largest over nodes of |field at the node - solution's displacement|, mm
};

struct Registration {
  VectorImage forward;     ///< preop_to_intraop: preop point -> displacement
  VectorImage resampling;  ///< intraop_to_preop: intraop point -> displacement back
  ScalarImage warped;
  std::optional<LabelMap> warped_labels;
  ScalarImage jacobian;             ///< of the forward map
  Points landmarks = Points(0, 3);  ///< intraop
  RegisterMeasures measures;
};

/// Runs the stage: fields on the T1's grid, warped images, measures.
Registration register_images(const RegisterInput& input, const RegisterOptions& options, const Progress& progress = {});

/// Points (landmarks, surface vertices) moved with a forward field, linear interpolation; zero displacement outside the
/// image; a point on the outermost half voxel is inside.
Points move_points(const VectorImage& forward, const Points& points);

/// An image or label map on any grid, resampled with the resampling field.
ScalarImage warp(const ScalarImage& image, const VectorImage& resampling, Interpolation interpolation);
LabelMap warp(const LabelMap& labels, const VectorImage& resampling);

/// The fields as an ITK displacement field transform (.h5: 3D Slicer, SimpleITK and ANTs load it). Throws
/// std::runtime_error when it cannot be written whole.
void write_transform(const std::filesystem::path& file, const VectorImage& field);

}  // namespace brainshift::registration
