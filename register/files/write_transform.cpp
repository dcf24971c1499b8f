// SPDX-License-Identifier: GPL-3.0-or-later
#include <H5Epublic.h>
#include <itkDisplacementFieldTransform.h>
#include <itkHDF5TransformIO.h>
#include <itkTransformFileWriter.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "register/registration.hpp"
#include "segmentation/image/itk_bridge.hpp"

namespace brainshift::registration {

namespace {

/// Voxels low to high, both included.
struct IndexBox {
  Eigen::Array3i low, high;
};

/// The voxels that move and one around them, so that the field ends in zeros; at least two along each axis.
IndexBox box_of_moving(const VectorImage& field) {
  const ImageGeometry& g = field.geometry;
  IndexBox box{g.size - 1, Eigen::Array3i::Zero()};
  for (int k = 0; k < g.size.z(); ++k) {
    for (int j = 0; j < g.size.y(); ++j) {
      for (int i = 0; i < g.size.x(); ++i) {
        if (field.at(i, j, k) != std::array<float, 3>{0, 0, 0}) {
          box.low = box.low.min(Eigen::Array3i(i, j, k));
          box.high = box.high.max(Eigen::Array3i(i, j, k));
        }
      }
    }
  }
  box.low = (box.low.min(box.high) - 1).max(0);
  box.high = (box.high + 1).min(g.size - 1);
  return box;
}

VectorImage cut(const VectorImage& field, const IndexBox& box) {
  VectorImage part{field.geometry, {}};
  part.geometry.size = box.high - box.low + 1;
  part.geometry.origin = field.geometry.to_world(box.low.cast<double>().matrix());
  part.voxels.reserve(part.geometry.voxel_count());
  for (int k = box.low.z(); k <= box.high.z(); ++k) {
    for (int j = box.low.y(); j <= box.high.y(); ++j) {
      const auto row = field.voxels.begin() + static_cast<std::ptrdiff_t>(field.geometry.offset(box.low.x(), j, k));
      part.voxels.insert(part.voxels.end(), row, row + part.geometry.size.x());
    }
  }
  return part;
}

}  // namespace

void write_transform(const std::filesystem::path& file, const VectorImage& field) {
  using Transform = itk::DisplacementFieldTransform<float, 3>;
  const auto transform = Transform::New();
  transform->SetDisplacementField(to_itk(cut(field, box_of_moving(field))));
  const auto writer = itk::TransformFileWriterTemplate<float>::New();
  writer->SetTransformIO(itk::HDF5TransformIOTemplate<float>::New());
  writer->SetFileName(file.string());
  writer->SetInput(transform);
  writer->SetUseCompression(true);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // what goes wrong is thrown, not printed
  try {
    writer->Update();
  } catch (const std::exception& fault) {
    throw std::runtime_error(file.string() +
                             ": could not be written whole; is the disk full or the folder read-only? (" +
                             fault.what() + ")");
  }
}

}  // namespace brainshift::registration
