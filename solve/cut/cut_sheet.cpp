// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_sheet.hpp"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/options/values.hpp"
#include "solve/cut/self_crossing.hpp"
#include "solve/cut/sheet_topology.hpp"

namespace brainshift::solve {
namespace {

/// The point array `time` of a file that read_surface() has read; empty without one.
std::vector<double> read_times(const std::filesystem::path& file) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  if (reader->CanReadFile(file.c_str()) == 0) {
    return {};  // no .vtp
  }
  reader->Update();
  vtkDataArray* array = reader->GetOutput()->GetPointData()->GetArray("time");
  if (array == nullptr) {
    return {};
  }
  if (array->GetNumberOfComponents() != 1) {
    throw std::invalid_argument(file.string() + ": the point array time has " +
                                std::to_string(array->GetNumberOfComponents()) + " numbers a point, one is expected");
  }
  std::vector<double> times;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    times.push_back(array->GetTuple1(i));
    if (!std::isfinite(times.back()) || times.back() < 0) {
      throw std::invalid_argument(file.string() + ": the time of point " + std::to_string(i + 1) + " is " +
                                  write_number(times.back()) +
                                  "; times of the load's curve are expected, finite and 0 or later");
    }
  }
  return times;
}

/// Leaves out the vertices that no triangle names, and their times.
void drop_unused(Surface& sheet, std::vector<double>& times) {
  std::vector<std::int32_t> renumbered(static_cast<std::size_t>(sheet.vertices.rows()), -1);
  std::vector<Eigen::Index> kept;
  for (auto& vertex : sheet.triangles.reshaped<Eigen::RowMajor>()) {
    std::int32_t& number = renumbered[static_cast<std::size_t>(vertex)];
    if (number < 0) {
      number = static_cast<std::int32_t>(kept.size());
      kept.push_back(vertex);
    }
    vertex = number;
  }
  sheet.vertices = Points(sheet.vertices(kept, Eigen::all));
  if (!times.empty()) {
    std::vector<double> of_kept;
    for (const Eigen::Index vertex : kept) {
      of_kept.push_back(times[static_cast<std::size_t>(vertex)]);
    }
    times = std::move(of_kept);
  }
}

/// How far along the direction of cutting each vertex is, mm.
std::vector<double> advance(const Points& vertices, const CutTiming& timing, const std::string& name) {
  if (timing.speed && timing.direction.isZero(0)) {
    throw std::invalid_argument(name +
                                ": a sheet with a speed needs the direction in which it is cut too; or give the time "
                                "at each vertex as the point array time of a .vtp");
  }
  const Eigen::VectorXd along = vertices * timing.direction.normalized();
  const double lowest = along.minCoeff();
  std::vector<double> distance;
  for (const double place : along) {
    distance.push_back(place - lowest);
  }
  return distance;
}

void check_crossing(const Surface& sheet, const std::string& name) {
  const auto meeting = meeting_triangles(sheet);
  if (meeting) {
    throw std::invalid_argument(name + ": the sheet crosses or touches itself, in triangles " +
                                std::to_string(meeting->first + 1) + " and " + std::to_string(meeting->second + 1) +
                                "; make it two cuts, which may cross each other");
  }
}

}  // namespace

Cut read_cut_sheet(const std::filesystem::path& file, const CutTiming& timing) {
  Cut cut;
  cut.name = file.string();
  Surface sheet = read_surface(file);
  std::vector<double> times = read_times(file);
  drop_unused(sheet, times);
  sheet = oriented_sheet(std::move(sheet), cut.name);
  check_crossing(sheet, cut.name);
  if (!times.empty()) {
    refuse_timing(timing, cut.name);
  }
  cut.time = times.empty() ? times_along(advance(sheet.vertices, timing, cut.name), timing, cut.name) : times;
  cut.vertices = std::move(sheet.vertices);
  cut.triangles = std::move(sheet.triangles);
  return cut;
}

}  // namespace brainshift::solve
