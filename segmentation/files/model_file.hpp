// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Bridge to VTK, for .cpp files: models with all that they hold. Not a public header.

#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>

#include "segmentation/files/frame.hpp"

namespace brainshift {

/// Reads the poly data of a .vtp with all arrays. Throws std::invalid_argument, naming the file, when it is none,
/// damaged or truncated.
vtkSmartPointer<vtkPolyData> read_vtp(const std::filesystem::path& file);

/// Surfaces, lines, points or grids of a .vtp, .vtu or legacy .vtk with all arrays. Throws as read_vtp(), and when
/// there is no point or one is not finite.
vtkSmartPointer<vtkPointSet> read_model(const std::filesystem::path& file);

/// Writes one by the file's ending; a .vtk as binary or text, as `as_in` is, and in its version. Throws
/// std::runtime_error when it cannot be written whole.
void write_model(const std::filesystem::path& file, vtkPointSet& model, const std::filesystem::path& as_in);

/// 3D Slicer notes the frame of a model in the field SPACE, or in a comment of the file's header. LPS without a note.
Frame frame_of_model(const std::filesystem::path& file, vtkDataObject& model);

/// The same of a file whose header is text.
Frame frame_in_header(const std::filesystem::path& file);

}  // namespace brainshift
