// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <itkDisplacementFieldTransform.h>
#include <itkHDF5TransformIO.h>
#include <itkTransformFileReader.h>
#include <filesystem>

namespace brainshift::registration {

using ItkTransform = itk::DisplacementFieldTransform<double, 3>;

/// As 3D Slicer and SimpleITK read it: in double precision.
inline ItkTransform::Pointer read_transform(const std::filesystem::path& file) {
  const auto reader = itk::TransformFileReaderTemplate<double>::New();
  reader->SetTransformIO(itk::HDF5TransformIOTemplate<double>::New());
  reader->SetFileName(file.string());
  reader->Update();
  return dynamic_cast<ItkTransform*>(reader->GetTransformList()->front().GetPointer());
}

}  // namespace brainshift::registration
