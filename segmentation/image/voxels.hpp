// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace brainshift {
namespace detail {

template <class Visit>
void for_each_voxel_of_layer(const Eigen::Array3i& size, int k, const Visit& visit) {
  for (int j = 0; j < size.y(); ++j) {
    for (int i = 0; i < size.x(); ++i) {
      visit(i, j, k);
    }
  }
}

}  // namespace detail

/// Calls visit(i, j, k) for each voxel of a grid of this size, in the order of storage.
template <class Visit>
void for_each_voxel(const Eigen::Array3i& size, const Visit& visit) {
  for (int k = 0; k < size.z(); ++k) {
    detail::for_each_voxel_of_layer(size, k, visit);
  }
}

/// The same by threads that share the layers: visit must change nothing that another voxel has a part in.
template <class Visit>
void for_each_voxel_in_parallel(const Eigen::Array3i& size, const Visit& visit) {
#pragma omp parallel for schedule(dynamic, 1)
  for (int k = 0; k < size.z(); ++k) {
    detail::for_each_voxel_of_layer(size, k, visit);
  }
}

}  // namespace brainshift
