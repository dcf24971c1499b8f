// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_model.hpp"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include "segmentation/files/model_file.hpp"

namespace brainshift::registration {

void warp_model(const std::filesystem::path& in, PointMover& mover, const std::filesystem::path& out) {
  const auto model = read_model(in);
  const Eigen::Vector3d to_lps = axes_to_lps(frame_of_model(in, *model));
  vtkPoints& points = *model->GetPoints();
  vtkPointData& arrays = *model->GetPointData();
  vtkNew<vtkFloatArray> displacement;
  displacement->SetName(arrays.HasArray("displacement") != 0 ? "warp_displacement" : "displacement");
  displacement->SetNumberOfComponents(3);
  displacement->SetNumberOfTuples(points.GetNumberOfPoints());
  for (vtkIdType p = 0; p < points.GetNumberOfPoints(); ++p) {
    Eigen::Vector3d place;
    points.GetPoint(p, place.data());
    const Eigen::Vector3d u = to_lps.cwiseProduct(mover.displacement(to_lps.cwiseProduct(place)));
    displacement->SetTuple(p, u.data());
    place += u;
    points.SetPoint(p, place.data());
  }
  arrays.AddArray(displacement);
  write_model(out, *model, in);
}

}  // namespace brainshift::registration
