// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Bridge to VTK, for .cpp files that read or write .vtu: not a public header.

#include <vtkCellType.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift::vtu {

/// Reads an XML unstructured grid, any encoding. Throws std::invalid_argument, naming the file, when it is missing,
/// empty, truncated or something else; VTK itself prints nothing.
vtkSmartPointer<vtkUnstructuredGrid> read(const std::filesystem::path& file);

/// Writes one: appended, base64, compressed; the same grid gives the same bytes. Throws std::runtime_error, naming the
/// file, when it cannot be written whole.
void write(const std::filesystem::path& file, vtkUnstructuredGrid& grid);

/// The same of poly data (.vtp).
void write(const std::filesystem::path& file, vtkPolyData& data);

/// A grid of one vertex cell a point.
vtkSmartPointer<vtkUnstructuredGrid> vertex_grid(const Points& positions);

vtkSmartPointer<vtkPoints> to_vtk(const Points& positions);

/// The grid's points; throws std::invalid_argument, naming file and point (called `what`), on a non-finite coordinate.
Points points(const std::filesystem::path& file, vtkUnstructuredGrid& grid, const std::string& what);

/// Adds an array of `components` values a row.
void add_array(vtkFieldData& data, const char* name, std::span<const double> values, int components = 1);
void add_array(vtkFieldData& data, const char* name, std::span<const std::int32_t> values);
void add_array(vtkFieldData& data, const char* name, std::span<const std::uint8_t> values);

/// The values of a named array of any number type, rows × components; empty when there is none of that name. Throws
/// std::invalid_argument, naming the file, when it has another size or holds no numbers.
std::vector<double> array(const std::filesystem::path& file, vtkFieldData& data, const char* name, std::size_t rows,
                          int components = 1);

/// The same of three values a row.
Points vectors(const std::filesystem::path& file, vtkFieldData& data, const char* name, std::size_t rows);

/// The same as array(), for whole numbers in the range of int32; else throws, naming file and row (called `what`).
std::vector<std::int32_t> whole_number_array(const std::filesystem::path& file, vtkFieldData& data, const char* name,
                                             std::size_t rows, const std::string& what);

}  // namespace brainshift::vtu
