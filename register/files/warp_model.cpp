// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_model.hpp"

#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>

#include "segmentation/files/free_name.hpp"
#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/model_file.hpp"
#include "segmentation/files/vtu_file.hpp"

namespace brainshift::registration {

namespace {

/// For an array that the model gets.
std::string name_for(vtkPointData& arrays, const std::string& name) {
  return free_name(name, [&](const std::string& each) { return arrays.HasArray(each.c_str()) != 0; });
}

/// Of whole numbers a place that moves would be cut to one.
void give_real_points(vtkPointSet& model) {
  const int type = model.GetPoints()->GetDataType();
  if (type != VTK_FLOAT && type != VTK_DOUBLE) {
    vtkNew<vtkPoints> points;
    points->SetDataType(VTK_DOUBLE);
    points->GetData()->DeepCopy(model.GetPoints()->GetData());
    model.SetPoints(points);
  }
}

}  // namespace

void warp_model(const std::filesystem::path& in, PointMover& mover, const std::filesystem::path& out) {
  const auto model = read_model(in);
  const Eigen::Vector3d to_lps = axes_to_lps(frame_of_model(in, *model));
  give_real_points(*model);
  vtkPoints& points = *model->GetPoints();
  vtkPointData& arrays = *model->GetPointData();
  vtkNew<vtkFloatArray> displacement;
  displacement->SetName(name_for(arrays, "displacement").c_str());
  displacement->SetNumberOfComponents(3);
  displacement->SetNumberOfTuples(points.GetNumberOfPoints());
  Points places(points.GetNumberOfPoints(), 3);
  for (vtkIdType p = 0; p < points.GetNumberOfPoints(); ++p) {
    Eigen::Vector3d place;
    points.GetPoint(p, place.data());
    places.row(p) = to_lps.cwiseProduct(place);
    const Eigen::Vector3d u = to_lps.cwiseProduct(mover.displacement(places.row(p)));
    displacement->SetTuple(p, u.data());
    place += u;
    points.SetPoint(p, place.data());
  }
  arrays.AddArray(displacement);
  const bool may_be_text = ending_of(in) == ".vtk";  // of which readers take no NaN
  for (const PointValues& each : may_be_text ? mover.finite_values(places) : mover.values(places)) {
    vtu::add_array(arrays, name_for(arrays, each.name).c_str(), each.values);
  }
  write_model(out, *model, in);
}

}  // namespace brainshift::registration
