// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkFieldData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <limits>
#include <sstream>
#include <stdexcept>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/files/vtk_bridge.hpp"
#include "segmentation/files/write_text.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

// The note by which 3D Slicer knows a model's frame.
constexpr const char* frame_note = "brainshift SPACE=LPS";

std::string as_vtp(const Surface& surface) {
  const auto data = to_vtk(surface);
  vtkNew<vtkStringArray> space;
  space->SetName("SPACE");
  space->InsertNextValue("LPS");
  data->GetFieldData()->AddArray(space);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

std::string as_obj(const Surface& surface) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "# " << frame_note << '\n';
  for (const auto& point : surface.vertices.rowwise()) {
    out << "v " << point[0] << ' ' << point[1] << ' ' << point[2] << '\n';
  }
  for (const auto& triangle : surface.triangles.rowwise()) {
    out << "f " << triangle[0] + 1 << ' ' << triangle[1] + 1 << ' ' << triangle[2] + 1 << '\n';
  }
  return out.str();
}

std::string as_ply(const Surface& surface) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "ply\nformat ascii 1.0\ncomment " << frame_note << "\nelement vertex " << surface.vertices.rows()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << surface.triangles.rows()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& point : surface.vertices.rowwise()) {
    out << point[0] << ' ' << point[1] << ' ' << point[2] << '\n';
  }
  for (const auto& triangle : surface.triangles.rowwise()) {
    out << "3 " << triangle[0] << ' ' << triangle[1] << ' ' << triangle[2] << '\n';
  }
  return out.str();
}

template <class T>
void append_bytes(std::string& text, const T& value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

// Binary: an 80 byte header, a count, then for each triangle normal (zero: to be computed), corners, two spare bytes.
std::string as_stl(const Surface& surface) {
  std::string text = frame_note;
  text.resize(80, ' ');
  append_bytes(text, static_cast<std::uint32_t>(surface.triangles.rows()));
  for (const auto& triangle : surface.triangles.rowwise()) {
    append_bytes(text, std::array<float, 3>{});
    for (const std::int32_t corner : triangle) {
      const Eigen::Vector3f point = surface.vertices.row(corner).cast<float>();
      append_bytes(text, std::array<float, 3>{point.x(), point.y(), point.z()});
    }
    append_bytes(text, std::uint16_t{0});
  }
  return text;
}

std::string as_text(const fs::path& file, const Surface& surface) {
  const std::string ending = ending_of(file);
  if (ending == ".vtp") {
    return as_vtp(surface);
  }
  if (ending == ".obj") {
    return as_obj(surface);
  }
  if (ending == ".ply") {
    return as_ply(surface);
  }
  if (ending == ".stl") {
    return as_stl(surface);
  }
  throw std::invalid_argument(file.string() + ": surfaces end in .vtp, .stl, .ply or .obj");
}

}  // namespace

void write_surface(const fs::path& file, const Surface& surface) {
  write_text(file, as_text(file, surface));
}

}  // namespace brainshift
