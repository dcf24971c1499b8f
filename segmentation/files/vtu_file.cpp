// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/vtu_file.hpp"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "segmentation/files/not_written.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/vtk_cells.hpp"
#include "segmentation/files/vtk_claims.hpp"
#include "segmentation/files/vtk_faults.hpp"
#include "segmentation/files/write_text.hpp"

namespace brainshift::vtu {
namespace {

template <class Array, class Value>
void add_typed_array(vtkFieldData& data, const char* name, std::span<const Value> values, int components) {
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  if (!values.empty()) {
    std::memcpy(array->GetVoidPointer(0), values.data(), values.size_bytes());
  }
  data.AddArray(array);
}

void write(const std::filesystem::path& file, vtkXMLWriter& writer, vtkDataObject& data) {
  // Through memory: only a stream of our own tells reliably whether every byte reached the disk.
  writer.SetInputDataObject(&data);
  writer.SetDataModeToAppended();
  writer.SetEncodeAppendedData(1);
  writer.SetCompressorTypeToZLib();
  writer.WriteToOutputStringOn();
  if (writer.Write() != 1) {
    fail_to_write(file);
  }
  write_text(file, writer.GetOutputString());
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read(const std::filesystem::path& file) {
  check_readable(file);
  check_vtk_claims(file);
  const FaultListener faults;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  faults.listen_to(*reader);
  reader->SetFileName(file.c_str());
  if (reader->CanReadFile(file.c_str()) == 0) {
    refuse(file, "this is no VTK XML unstructured grid (.vtu), or it is damaged.");
  }
  reader->Update();
  if (faults.failed() || reader->GetErrorCode() != 0) {
    refuse(file, "the unstructured grid (.vtu) is damaged or truncated; write it again.");
  }
  vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  check_cells(file, *grid);
  return grid;
}

void write(const std::filesystem::path& file, vtkUnstructuredGrid& grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write(file, *writer, grid);
}

void write(const std::filesystem::path& file, vtkPolyData& data) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  write(file, *writer, data);
}

vtkSmartPointer<vtkPoints> to_vtk(const Points& positions) {
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(positions.rows());
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    result->SetPoint(i, positions.row(i).data());
  }
  return result;
}

vtkSmartPointer<vtkUnstructuredGrid> vertex_grid(const Points& positions) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(to_vtk(positions));
  grid->AllocateEstimate(positions.rows(), 1);
  for (vtkIdType node = 0; node < positions.rows(); ++node) {
    grid->InsertNextCell(VTK_VERTEX, 1, &node);
  }
  return grid;
}

Points points(const std::filesystem::path& file, vtkUnstructuredGrid& grid, const std::string& what) {
  Points result(grid.GetNumberOfPoints(), 3);
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    grid.GetPoint(i, result.row(i).data());
    if (!result.row(i).allFinite()) {
      refuse(file, what + " " + std::to_string(i) + " has a coordinate that is not finite.");
    }
  }
  return result;
}

void add_array(vtkFieldData& data, const char* name, std::span<const double> values, int components) {
  add_typed_array<vtkDoubleArray>(data, name, values, components);
}

void add_array(vtkFieldData& data, const char* name, std::span<const std::int32_t> values) {
  add_typed_array<vtkIntArray>(data, name, values, 1);
}

void add_array(vtkFieldData& data, const char* name, std::span<const std::uint8_t> values) {
  add_typed_array<vtkUnsignedCharArray>(data, name, values, 1);
}

std::vector<double> array(const std::filesystem::path& file, vtkFieldData& data, const char* name, std::size_t rows,
                          int components) {
  vtkAbstractArray* any = data.GetAbstractArray(name);
  if (any == nullptr) {
    return {};
  }
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(any);
  if (numbers == nullptr) {
    refuse(file, std::string("array ") + name + " holds no numbers.");
  }
  if (numbers->GetNumberOfComponents() != components || numbers->GetNumberOfTuples() != static_cast<vtkIdType>(rows)) {
    refuse(file, std::string("array ") + name + " has " + std::to_string(numbers->GetNumberOfTuples()) + " rows of " +
                     std::to_string(numbers->GetNumberOfComponents()) + " components; " + std::to_string(rows) +
                     " rows of " + std::to_string(components) + " are expected.");
  }
  std::vector<double> values(rows * static_cast<std::size_t>(components));
  for (std::size_t row = 0; row < rows; ++row) {
    numbers->GetTuple(static_cast<vtkIdType>(row), values.data() + row * static_cast<std::size_t>(components));
  }
  return values;
}

Points vectors(const std::filesystem::path& file, vtkFieldData& data, const char* name, std::size_t rows) {
  const std::vector<double> values = array(file, data, name, rows, 3);
  return Eigen::Map<const Points>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3);
}

std::vector<std::int32_t> whole_number_array(const std::filesystem::path& file, vtkFieldData& data, const char* name,
                                             std::size_t rows, const std::string& what) {
  const std::vector<double> values = array(file, data, name, rows);
  std::vector<std::int32_t> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool in_range = std::abs(values[i]) <= std::numeric_limits<std::int32_t>::max();
    if (!in_range || values[i] != std::round(values[i])) {
      refuse(file, std::string("array ") + name + " of " + what + " " + std::to_string(i) + " is " +
                       std::to_string(values[i]) + "; a whole number is expected.");
    }
    result[i] = static_cast<std::int32_t>(values[i]);
  }
  return result;
}

}  // namespace brainshift::vtu
