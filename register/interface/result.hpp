// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::registration {

struct RegisterMeasures {
  std::size_t brain_voxels = 0;
  std::size_t cavity_voxels = 0;      ///< of the brain's, before they move, those that a resection has taken out
  std::size_t cavity_landmarks = 0;   ///< landmarks in what it has taken out
  std::size_t landmarks_outside = 0;  ///< of the grid: they stay where they were
  std::size_t moved_voxels = 0;       ///< of the forward field: not zero
  double inverse_mean = 0;            ///< over the brain's voxels x: |forward(x) + resampling(x + forward(x))|, mm
  double inverse_999 = 0;             ///< 99.9th percentile, mm
  double inverse_max = 0;             ///< mm
  std::size_t not_inverted = 0;       ///< voxels where the inversion missed its tolerance
  double jacobian_min = 0;            ///< over the brain, of the forward map
  double jacobian_max = 0;            ///< over the brain
  double field_jacobian_min = 0;      ///< over all voxels, the faded field outside the brain too
  std::size_t folded_voxels = 0;      ///< where the Jacobian is not positive
  double largest_displacement = 0;    ///< over the voxels, mm
  std::size_t without_nodes = 0;      ///< of the brain's voxels, about: those over 1.5 spacings from every node
  double fit_error = 0;               ///< largest over nodes of |field at the node - solution's displacement|, mm
  double seconds = 0;                 ///< that fields and warped images took
};

struct Registration {
  VectorImage forward;     ///< preop_to_intraop: preop point -> displacement, rounded to 1/4096 mm
  VectorImage resampling;  ///< intraop_to_preop: intraop point -> displacement back, rounded to 1/4096 mm
  ScalarImage warped;      ///< without voxels where the T1 has none
  std::optional<LabelMap> warped_labels;
  std::optional<LabelMap> removed;               ///< preop, 1 where a resection has taken tissue out; absent: none was
  ScalarImage jacobian;                          ///< determinant of the forward map's gradient, in the world
  Points landmarks = Points(0, 3);               ///< intraop
  Points preop_landmarks = Points(0, 3);         ///< as they came in
  std::vector<std::string> landmark_names = {};  ///< one each, as users call them; none: they have numbers
  std::vector<double> landmark_error;  ///< the solution's estimated error at each, mm, NaN outside and in what
                                       ///< was taken out; none without one
  RegisterMeasures measures;
};

}  // namespace brainshift::registration
