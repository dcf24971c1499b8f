// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/show/shown_fields.hpp"

#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include "register/field/nodal_values.hpp"
#include "register/warp/point_mover.hpp"
#include "segmentation/files/vtk_bridge.hpp"
#include "segmentation/files/vtu_file.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;

void write_brain(const fs::path& file, const Solution& solution, Surface brain, const VectorImage& forward) {
  const auto data = to_vtk(brain);
  registration::PointMover mover(forward);
  const Points moved = registration::move_points(mover, brain.vertices);
  const Points u = moved - brain.vertices;
  const Eigen::VectorXd length = u.rowwise().norm();
  data->SetPoints(vtu::to_vtk(moved));
  vtkPointData& arrays = *data->GetPointData();
  vtu::add_array(arrays, "displacement", {u.data(), static_cast<std::size_t>(u.size())}, 3);
  vtu::add_array(arrays, "displacement_mm", {length.data(), static_cast<std::size_t>(length.size())});
  if (!solution.estimated_error.empty()) {
    vtu::add_array(arrays, "estimated_error_mm", registration::estimated_error_at(solution, brain.vertices));
  }
  arrays.SetActiveScalars("displacement_mm");
  vtkNew<vtkStringArray> space;  // 3D Slicer's note
  space->SetName("SPACE");
  space->InsertNextValue("LPS");
  data->GetFieldData()->AddArray(space);
  vtu::write(file, *data);
}

}  // namespace

void write_nodal_image(const fs::path& file, const Solution& solution, const std::vector<double>& values) {
  const ImageGeometry grid = registration::grid_around_nodes(solution, true);
  write_image(file, registration::nodal_values_on(solution, values, true, grid));
}

void write_shown_fields(const fs::path& folder, const Solution& solution, const Surface& brain,
                        const VectorImage& forward) {
  write_brain(folder / "brain_intraop.vtp", solution, brain, forward);
  if (!solution.estimated_error.empty()) {
    write_nodal_image(folder / "estimated_error.nii.gz", solution, solution.estimated_error);
  }
}

}  // namespace brainshift::pipelines
