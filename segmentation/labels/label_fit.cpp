// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/labels/label_fit.hpp"

#include "segmentation/image/itk_bridge.hpp"  // before ITK's headers

#include <itkSmoothingRecursiveGaussianImageFilter.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/image/mask.hpp"
#include "segmentation/image/voxels.hpp"

namespace brainshift::segmentation {
namespace {

constexpr double beside = 4;  // mm

Eigen::Array3i steps_of(const ImageGeometry& grid) {
  return (beside / grid.spacing.array()).round().cast<int>().max(1);
}

ScalarImage smoothed(const ScalarImage& t1) {
  constexpr double width = 1;  // mm
  using Filter = itk::SmoothingRecursiveGaussianImageFilter<ItkImage<float>, ItkImage<float>>;
  const auto filter = Filter::New();
  Filter::SigmaArrayType sigma;
  for (unsigned axis = 0; axis < 3; ++axis) {
    sigma[axis] = std::max(width, 0.5 * t1.geometry.spacing[axis]);  // the filter is none for less of a voxel
  }
  filter->SetSigmaArray(sigma);
  filter->SetInput(seen_by_itk(t1));
  filter->Update();
  return from_itk<float>(*filter->GetOutput());
}

// The T1 around the brain, as the mask's part was cropped.
ScalarImage part_of(const ScalarImage& t1, const ImageGeometry& part) {
  const Eigen::Array3i lower = t1.geometry.to_index(part.origin).array().round().cast<int>();
  ScalarImage result{part, std::vector<float>(part.voxel_count())};
  for_each_voxel(part.size, [&](int i, int j, int k) {
    const Eigen::Array3i from = (lower + Eigen::Array3i(i, j, k)).max(0).min(t1.geometry.size - 1);
    result.at(i, j, k) = t1.at(from.x(), from.y(), from.z());
  });
  return result;
}

// Offsets of the voxels on both sides of a face of the boundary.
struct Face {
  std::ptrdiff_t inner;
  std::ptrdiff_t outer;
};

// Those from which a shift along any axis does not leave the image.
std::vector<Face> boundary_of(const Mask& brain, const Eigen::Array3i& margin) {
  const Eigen::Array3i& size = brain.geometry.size;
  std::vector<Face> faces;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Array3i step = (Eigen::Array3i() << (axis == 0), (axis == 1), (axis == 2)).finished();
    for (int k = margin.z(); k + step.z() < size.z() - margin.z(); ++k) {
      for (int j = margin.y(); j + step.y() < size.y() - margin.y(); ++j) {
        for (int i = margin.x(); i + step.x() < size.x() - margin.x(); ++i) {
          const std::size_t here = brain.geometry.offset(i, j, k);
          const std::size_t next = brain.geometry.offset(i + step.x(), j + step.y(), k + step.z());
          if (brain.voxels[here] != brain.voxels[next]) {
            faces.push_back({static_cast<std::ptrdiff_t>(here), static_cast<std::ptrdiff_t>(next)});
          }
        }
      }
    }
  }
  return faces;
}

double mean_change(const std::vector<Face>& faces, const ScalarImage& t1, std::ptrdiff_t shift) {
  double sum = 0;
  for (const Face& face : faces) {
    sum += std::abs(t1.voxels[static_cast<std::size_t>(face.inner + shift)] -
                    t1.voxels[static_cast<std::size_t>(face.outer + shift)]);
  }
  return sum / static_cast<double>(faces.size());
}

}  // namespace

std::optional<double> label_fit(const ScalarImage& t1, const LabelMap& labels, std::span<const std::uint16_t> brain) {
  const Mask whole = mask_of(labels, brain);
  if (count(whole) == 0) {
    return std::nullopt;
  }
  const Eigen::Array3i steps = steps_of(t1.geometry);
  const Mask mask = cropped(whole, steps + 1);
  const auto faces = boundary_of(mask, steps);
  constexpr std::size_t enough = 1000;
  if (faces.size() < enough) {
    return std::nullopt;
  }
  const ScalarImage part = part_of(t1, mask.geometry);
  const ScalarImage image = smoothed(part);
  double aside = 0;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Array3i to = Eigen::Array3i::Zero();
    to[axis] = steps[axis];
    const auto shift = static_cast<std::ptrdiff_t>(mask.geometry.offset(to.x(), to.y(), to.z()));
    aside += (mean_change(faces, image, shift) + mean_change(faces, image, -shift)) / 6;
  }
  const auto [darkest, brightest] = std::minmax_element(part.voxels.begin(), part.voxels.end());
  constexpr double least_contrast = 1e-4;  // of the T1's range; rounding makes less
  const bool contrast = aside > least_contrast * (*brightest - *darkest) && *brightest > *darkest;
  return contrast ? std::optional(mean_change(faces, image, 0) / aside) : std::nullopt;
}

}  // namespace brainshift::segmentation
