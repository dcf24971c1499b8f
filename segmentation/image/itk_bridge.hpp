// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private to .cpp files of segmentation and register: our images as ITK's and back.
// Include it before any of ITK's headers.

#include <Eigen/Dense>  // before ITK, which brings an Eigen of its own under the same include guards

#include <itkImage.h>
#include <itkVector.h>

#include <algorithm>
#include <array>
#include <bit>

#include "segmentation/image/image.hpp"

namespace brainshift {

template <class T>
struct ItkPixel {
  using type = T;
};
template <>
struct ItkPixel<std::array<float, 3>> {
  using type = itk::Vector<float, 3>;
};

template <class T>
using ItkImage = itk::Image<typename ItkPixel<T>::type, 3>;

/// Gives an ITK image of any pixel our geometry, but no voxels yet.
template <class Pixel>
void set_grid(itk::Image<Pixel, 3>& image, const ImageGeometry& geometry) {
  typename itk::Image<Pixel, 3>::SizeType size;
  typename itk::Image<Pixel, 3>::SpacingType spacing;
  typename itk::Image<Pixel, 3>::PointType origin;
  typename itk::Image<Pixel, 3>::DirectionType direction;
  for (unsigned row = 0; row < 3; ++row) {
    size[row] = static_cast<itk::SizeValueType>(geometry.size[row]);
    spacing[row] = geometry.spacing[row];
    origin[row] = geometry.origin[row];
    for (unsigned column = 0; column < 3; ++column) {
      direction(row, column) = geometry.direction(row, column);
    }
  }
  image.SetRegions(size);
  image.SetSpacing(spacing);
  image.SetOrigin(origin);
  image.SetDirection(direction);
}

/// The same; the voxels are allocated but not set.
template <class Pixel>
void set_geometry(itk::Image<Pixel, 3>& image, const ImageGeometry& geometry) {
  set_grid(image, geometry);
  image.Allocate();
}

template <class ItkImageType>
ImageGeometry geometry_of(const ItkImageType& image) {
  const auto& region = image.GetLargestPossibleRegion();
  ImageGeometry geometry;
  for (unsigned row = 0; row < 3; ++row) {
    geometry.size[row] = static_cast<int>(region.GetSize()[row]);
    geometry.spacing[row] = image.GetSpacing()[row];
    geometry.origin[row] = image.GetOrigin()[row];
    for (unsigned column = 0; column < 3; ++column) {
      geometry.direction(row, column) = image.GetDirection()(row, column);
    }
  }
  return geometry;
}

/// Our image as ITK's without a copy, for filters that only read it; it must outlive the result. Pixel: of the same
/// bytes.
template <class T, class Pixel = typename ItkPixel<T>::type>
typename itk::Image<Pixel, 3>::Pointer seen_by_itk(const Image<T>& image) {
  static_assert(sizeof(Pixel) == sizeof(T));
  auto result = itk::Image<Pixel, 3>::New();
  set_grid(*result, image.geometry);
  auto* const voxels = const_cast<T*>(image.voxels.data());  // ITK has no images of const voxels
  result->GetPixelContainer()->SetImportPointer(reinterpret_cast<Pixel*>(voxels), image.voxels.size(), false);
  return result;
}

/// The whole image must be buffered and start at index zero, as readers and filters leave it.
template <class T>
Image<T> from_itk(const ItkImage<T>& image) {
  Image<T> result;
  result.geometry = geometry_of(image);
  result.voxels.resize(result.geometry.voxel_count());
  using Pixel = typename ItkPixel<T>::type;
  std::transform(image.GetBufferPointer(), image.GetBufferPointer() + result.voxels.size(), result.voxels.begin(),
                 [](const Pixel& value) { return std::bit_cast<T>(value); });
  return result;
}

}  // namespace brainshift
