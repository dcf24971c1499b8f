// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipelines/scene/scene.hpp"
#include "pipelines/scene/solve_cost.hpp"

namespace brainshift::pipelines {

/// What a run's memory and time depend on: estimates.
struct RunSize {
  SolveSize solve;
  double voxels = 0;        ///< of the grid that the run works on: the T1's, else the labels'
  double label_voxels = 0;  ///< of the label map or mask as it is read
};

/// Of a checked scene, whose images are read. Throws as their readers do.
RunSize run_size(const Scene& scene);

/// The same from the headers of the images alone, for a brain of 1.4 litres; folders of DICOM slices count for nothing.
RunSize declared_run_size(const Scene& scene);

}  // namespace brainshift::pipelines
