// SPDX-License-Identifier: GPL-3.0-or-later
#include <itkBSplineInterpolateImageFunction.h>
#include <itkLinearInterpolateImageFunction.h>
#include <omp.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "register/field/field_sampler.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/image/itk_bridge.hpp"

namespace brainshift::registration {

namespace {

Eigen::Vector3d displacement_of_voxel(const VectorImage& field, int i, int j, int k) {
  const std::array<float, 3>& d = field.at(i, j, k);
  return {d[0], d[1], d[2]};
}

/// The image on a grid, each voxel being look_up(continuous index of its preop place, thread); 0 where that lies
/// outside the image. On the image's own grid a voxel that does not move is not looked up: itk::WarpImageFilter would
/// interpolate there, too, which changes bits.
template <class T, class LookUp>
Image<T> resample(const Image<T>& image, const VectorImage& resampling, const ImageGeometry& grid,
                  const LookUp& look_up) {
  const ImageGeometry& g = image.geometry;
  const FieldSampler field(resampling);
  const bool on_own_grid = same_geometry(g, grid);
  const bool on_the_fields_grid = same_geometry(grid, resampling.geometry);
  const Eigen::Matrix3d to_voxels = g.index_from_world();
  const Eigen::Array3d high = g.size.cast<double>() - 0.5;
  const auto field_at = [&](const Eigen::Vector3d& index) -> Eigen::Vector3d {
    const Eigen::Vector3d at = field.to_index(grid.to_world(index));
    return field.inside(at) ? field.value(at) : Eigen::Vector3d::Zero();
  };
  Image<T> result{grid, on_own_grid ? image.voxels : std::vector<T>(grid.voxel_count())};
#pragma omp parallel for schedule(dynamic, 1)
  for (int k = 0; k < grid.size.z(); ++k) {
    for (int j = 0; j < grid.size.y(); ++j) {
      for (int i = 0; i < grid.size.x(); ++i) {
        const Eigen::Vector3d index(i, j, k);
        const Eigen::Vector3d d = on_the_fields_grid ? displacement_of_voxel(resampling, i, j, k) : field_at(index);
        if (on_own_grid && d == Eigen::Vector3d::Zero()) {
          continue;
        }
        const Eigen::Vector3d here = on_own_grid ? index : to_voxels * (grid.to_world(index) - g.origin);
        const Eigen::Vector3d preop = here + to_voxels * d;
        const bool inside = (preop.array() >= -0.5).all() && (preop.array() <= high).all();
        result.at(i, j, k) = inside ? look_up(preop, omp_get_thread_num()) : T{0};
      }
    }
  }
  return result;
}

itk::ContinuousIndex<double, 3> as_itk(const Eigen::Vector3d& index) {
  itk::ContinuousIndex<double, 3> result;
  for (unsigned axis = 0; axis < 3; ++axis) {
    result[axis] = index[axis];
  }
  return result;
}

using ItkScalar = itk::Image<float, 3>;

ScalarImage warp_linear(const ScalarImage& image, const VectorImage& resampling, const ImageGeometry& grid) {
  const ItkScalar::Pointer voxels = seen_by_itk(image);
  const auto interpolator = itk::LinearInterpolateImageFunction<ItkScalar, double>::New();
  interpolator->SetInputImage(voxels);
  return resample(image, resampling, grid, [&](const Eigen::Vector3d& index, int) {
    return static_cast<float>(interpolator->EvaluateAtContinuousIndex(as_itk(index)));
  });
}

ScalarImage warp_bspline(const ScalarImage& image, const VectorImage& resampling, const ImageGeometry& grid) {
  if ((image.geometry.size < 4).any()) {
    throw std::invalid_argument(
        "cubic B-splines need at least four voxels along each axis of the image; use linear interpolation");
  }
  const ItkScalar::Pointer voxels = seen_by_itk(image);
  const auto interpolator = itk::BSplineInterpolateImageFunction<ItkScalar, double, float>::New();
  interpolator->SetSplineOrder(3);
  interpolator->SetNumberOfWorkUnits(static_cast<itk::ThreadIdType>(omp_get_max_threads()));
  interpolator->SetInputImage(voxels);
  return resample(image, resampling, grid, [&](const Eigen::Vector3d& index, int thread) {
    return static_cast<float>(
        interpolator->EvaluateAtContinuousIndex(as_itk(index), static_cast<itk::ThreadIdType>(thread)));
  });
}

}  // namespace

ScalarImage warp(const ScalarImage& image, const VectorImage& resampling, Interpolation interpolation,
                 const ImageGeometry& grid) {
  return interpolation == Interpolation::linear ? warp_linear(image, resampling, grid)
                                                : warp_bspline(image, resampling, grid);
}

ScalarImage warp(const ScalarImage& image, const VectorImage& resampling, Interpolation interpolation) {
  return warp(image, resampling, interpolation, image.geometry);
}

LabelMap warp(const LabelMap& labels, const VectorImage& resampling, const ImageGeometry& grid) {
  return resample(labels, resampling, grid, [&](const Eigen::Vector3d& index, int) {
    const Eigen::Array3i last = labels.geometry.size - 1;
    const Eigen::Array3i nearest = (index.array() + 0.5).floor().cast<int>().max(0).min(last);
    return labels.at(nearest.x(), nearest.y(), nearest.z());
  });
}

LabelMap warp(const LabelMap& labels, const VectorImage& resampling) {
  return warp(labels, resampling, labels.geometry);
}

}  // namespace brainshift::registration
