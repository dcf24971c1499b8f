// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/itk_bridge.hpp"

#include <itkCastImageFilter.h>
#include <itkDiscreteGaussianImageFilter.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include "segmentation/files/vtk_bridge.hpp"
#include "segmentation/surface/extract.hpp"

namespace brainshift::segmentation {
namespace {

ScalarImage smoothed(const Mask& mask, double sigma) {
  const ScalarImage sharp{mask.geometry, std::vector<float>(mask.voxels.begin(), mask.voxels.end())};
  if (!(sigma > 0)) {
    return sharp;
  }
  auto filter = itk::DiscreteGaussianImageFilter<ItkImage<float>, ItkImage<float>>::New();
  const auto seen = seen_by_itk(sharp);
  filter->SetInput(seen);
  filter->SetVariance(sigma * sigma);
  filter->SetUseImageSpacing(true);
  filter->SetMaximumKernelWidth(64);
  filter->SetMaximumError(0.001);
  filter->Update();
  return from_itk<float>(*filter->GetOutput());
}

// Every stride-th voxel of each axis.
ScalarImage thinned(const ScalarImage& image, const Eigen::Array3i& stride) {
  ScalarImage result;
  result.geometry = image.geometry;
  result.geometry.size = (image.geometry.size - 1) / stride + 1;
  result.geometry.spacing = image.geometry.spacing.cwiseProduct(stride.cast<double>().matrix());
  result.voxels.reserve(result.geometry.voxel_count());
  for (int k = 0; k < image.geometry.size.z(); k += stride.z()) {
    for (int j = 0; j < image.geometry.size.y(); j += stride.y()) {
      for (int i = 0; i < image.geometry.size.x(); i += stride.x()) {
        result.voxels.push_back(image.at(i, j, k));
      }
    }
  }
  return result;
}

// Contoured on the grid of indices; the image's frame comes in afterwards, as VTK knows no left-handed direction.
Surface contour(ScalarImage& image) {
  const Eigen::Array3i size = image.geometry.size;
  vtkNew<vtkFloatArray> values;
  constexpr int keep_ownership = 1;
  values->SetArray(image.voxels.data(), static_cast<vtkIdType>(image.voxels.size()), keep_ownership);
  vtkNew<vtkImageData> data;
  data->SetDimensions(size.x(), size.y(), size.z());
  data->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(data);
  edges->ComputeNormalsOff();
  edges->ComputeGradientsOff();
  edges->ComputeScalarsOff();
  constexpr double half_way = 0.50001;  // not met exactly by a voxel, where triangles would degenerate
  edges->SetValue(0, half_way);
  edges->Update();
  return from_vtk(*edges->GetOutput());
}

}  // namespace

Surface iso_surface(const Mask& mask, double sigma) {
  const Eigen::Array3d spacing = mask.geometry.spacing.array();
  // Twice sigma is the widest step at which the contour, linear between voxels, is still within a tenth of sigma.
  const Eigen::Array3i stride = (2.0 * sigma / spacing + 1e-6).floor().cast<int>().max(1);
  const Mask part = cropped(mask, voxels_to(3.0 * sigma, mask.geometry) + 2 * stride);
  ScalarImage field = thinned(smoothed(part, sigma), stride);
  Surface surface = contour(field);
  for (auto vertex : surface.vertices.rowwise()) {
    const Eigen::Vector3d index = vertex.transpose();
    vertex = field.geometry.to_world(index).transpose();
  }
  if (volume(surface) < 0) {
    surface = turned_over(std::move(surface));
  }
  return surface;
}

}  // namespace brainshift::segmentation
