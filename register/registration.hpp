// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
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
  double fade = 20.0;  ///< distance outside the brain over which the field goes to zero, mm; it does not fold while
                       ///< displacements away from the brain stay below about 0.7 of it
  Interpolation interpolation = Interpolation::linear;
  double inverse_tolerance = 0.01;  ///< of the inversion at the voxels, mm
};

struct RegisterInput {
  Solution solution;
  Surface brain;  ///< preop brain surface, closed, outward: outside it the field fades
  ScalarImage t1;
  std::optional<LabelMap> labels;   ///< on the T1's grid
  Points landmarks = Points(0, 3);  ///< preop, mm LPS
};

struct RegisterMeasures {
  std::size_t brain_voxels = 0;
  std::size_t moved_voxels = 0;     ///< of the forward field: not zero
  double inverse_mean = 0;          ///< over the brain's voxels x: |forward(x) + resampling(x + forward(x))|, mm
  double inverse_999 = 0;           ///< 99.9th percentile, mm
  double inverse_max = 0;           ///< mm
  std::size_t not_inverted = 0;     ///< voxels where the inversion missed its tolerance
  double jacobian_min = 0;          ///< over the brain, of the forward map
  double jacobian_max = 0;          ///< over the brain
  double field_jacobian_min = 0;    ///< over all voxels, the faded field outside the brain too
  std::size_t folded_voxels = 0;    ///< where the Jacobian is not positive
  double largest_displacement = 0;  ///< over the voxels, mm
  double fit_error = 0;             ///< largest over nodes of |field at the node - solution's displacement|, mm
  double seconds = 0;               ///< that fields and warped images took
};

struct Registration {
  VectorImage forward;     ///< preop_to_intraop: preop point -> displacement, rounded to 1/4096 mm
  VectorImage resampling;  ///< intraop_to_preop: intraop point -> displacement back, rounded to 1/4096 mm
  ScalarImage warped;
  std::optional<LabelMap> warped_labels;
  ScalarImage jacobian;                   ///< determinant of the forward map's gradient, in the world
  Points landmarks = Points(0, 3);        ///< intraop
  Points preop_landmarks = Points(0, 3);  ///< as they came in
  RegisterMeasures measures;
};

/// Runs the stage: fields on the T1's grid, warped images, measures. Folding and voxels that could not be inverted are
/// counted in the measures, not repaired. Throws std::invalid_argument when labels and T1 do not share a grid, the
/// surface is open or does not meet the image, the solution does not fit the brain, or an option is out of range.
Registration register_images(const RegisterInput& input, const RegisterOptions& options, const Progress& progress = {});

/// Points (landmarks, surface vertices) moved with a forward field, linear interpolation; zero displacement outside the
/// image; a point on the outermost half voxel is inside.
Points move_points(const VectorImage& forward, const Points& points);

/// An image or label map on any grid, resampled on its own grid with the resampling field: linear or cubic B-spline,
/// labels by the nearest voxel. A voxel that does not move keeps its value bit for bit; 0 comes in from outside the
/// image. Throws std::invalid_argument when an image has fewer than four voxels along an axis and B-splines are wanted.
ScalarImage warp(const ScalarImage& image, const VectorImage& resampling, Interpolation interpolation);
LabelMap warp(const LabelMap& labels, const VectorImage& resampling);

/// The fields as an ITK displacement field transform (.h5: 3D Slicer, SimpleITK and ANTs load it), in single precision,
/// cut to the box where the field is not zero: such a transform is the identity outside its grid. Throws
/// std::runtime_error when it cannot be written whole.
void write_transform(const std::filesystem::path& file, const VectorImage& field);

/// Writes warped.nii.gz, warped_labels.nii.gz, intraop_to_preop and preop_to_intraop (.nii.gz and .h5), jacobian.nii.gz
/// and landmarks.csv (`label,x,y,z` preop, `intraop_x,…`, `ux,uy,uz`, mm LPS) into an existing folder; labels and
/// landmarks only when there are any. Throws std::runtime_error, naming the file, when one cannot be written whole.
void write_registration(const std::filesystem::path& folder, const Registration& registration);

}  // namespace brainshift::registration
