// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <vtkTriangleFilter.h>

#include <algorithm>
#include <stdexcept>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/model_file.hpp"
#include "segmentation/files/ply_claims.hpp"
#include "segmentation/files/read_obj.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/files/vtk_bridge.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;
using CgalPoint = CGAL::Simple_cartesian<double>::Point_3;

PolygonSoup read_with_cgal(const fs::path& file, const std::string& ending) {
  if (ending == ".ply") {
    check_ply_claims(file);
  }
  std::vector<CgalPoint> points;
  PolygonSoup soup;
  const auto quiet = CGAL::parameters::verbose(false);
  const bool read = ending == ".stl" ? CGAL::IO::read_STL(file.string(), points, soup.polygons, quiet)
                                     : CGAL::IO::read_PLY(file.string(), points, soup.polygons, quiet);
  if (!read) {
    throw std::invalid_argument(file.string() + ": is no " + ending +
                                " surface, or is damaged or truncated; copy it again");
  }
  soup.points.reserve(points.size());
  for (const CgalPoint& point : points) {
    soup.points.push_back({point.x(), point.y(), point.z()});
  }
  return soup;
}

vtkSmartPointer<vtkPolyData> to_vtk(const fs::path& file, const PolygonSoup& soup) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& point : soup.points) {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& polygon : soup.polygons) {
    cells->InsertNextCell(static_cast<int>(polygon.size()));
    for (const std::size_t corner : polygon) {
      if (corner >= soup.points.size()) {
        throw std::invalid_argument(file.string() + ": a face names vertex " + std::to_string(corner + 1) + " of " +
                                    std::to_string(soup.points.size()));
      }
      cells->InsertCellPoint(static_cast<vtkIdType>(corner));
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(cells);
  return result;
}

void check_values(const fs::path& file, const Surface& surface) {
  if (surface.triangles.rows() == 0) {
    throw std::invalid_argument(file.string() + ": holds no face; a triangulated surface is needed");
  }
  for (Eigen::Index i = 0; i < surface.vertices.rows(); ++i) {
    if (!surface.vertices.row(i).allFinite()) {
      throw std::invalid_argument(file.string() + ": vertex " + std::to_string(i + 1) + " of " +
                                  std::to_string(surface.vertices.rows()) + " is not finite");
    }
  }
  if (surface.triangles.minCoeff() < 0 || surface.triangles.maxCoeff() >= surface.vertices.rows()) {
    throw std::invalid_argument(file.string() + ": a face names a vertex that the file lacks");
  }
  const double across = extent(surface);
  if (!(area(surface) > 1e-12 * across * across)) {
    throw std::invalid_argument(file.string() +
                                ": its faces lie in one point or line; a surface with an area is needed");
  }
}

vtkSmartPointer<vtkPolyData> read_polygons(const fs::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".vtp") {
    return read_vtp(file);
  }
  if (ending == ".obj") {
    return to_vtk(file, read_obj(file));
  }
  if (ending == ".stl" || ending == ".ply") {
    return to_vtk(file, read_with_cgal(file, ending));
  }
  throw std::invalid_argument(file.string() + ": surfaces end in .vtp, .stl, .ply or .obj");
}

}  // namespace

Surface read_surface(const fs::path& file) {
  check_readable(file);
  const auto polygons = read_polygons(file);
  vtkNew<vtkTriangleFilter> triangulate;
  triangulate->SetInputData(polygons);
  triangulate->PassLinesOff();
  triangulate->PassVertsOff();
  triangulate->Update();
  Surface surface = from_vtk(*triangulate->GetOutput());
  check_values(file, surface);
  if (frame_of_model(file, *polygons) == Frame::ras) {
    surface.vertices.leftCols<2>() *= -1.0;
  }
  return surface;
}

}  // namespace brainshift
