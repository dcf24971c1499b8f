// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/show/shown_fields.hpp"

#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <array>
#include <cmath>

#include "register/warp/point_mover.hpp"
#include "segmentation/files/vtk_bridge.hpp"
#include "segmentation/files/vtu_file.hpp"
#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;

constexpr double voxel = 4;  // mm; nodes are as far apart, and more

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
    vtu::add_array(arrays, "estimated_error_mm", estimated_error_at(solution, false, brain.vertices));
  }
  arrays.SetActiveScalars("displacement_mm");
  vtkNew<vtkStringArray> space;  // 3D Slicer's note
  space->SetName("SPACE");
  space->InsertNextValue("LPS");
  data->GetFieldData()->AddArray(space);
  vtu::write(file, *data);
}

/// Around the nodes as they lie intraop.
ImageGeometry error_grid(const Solution& solution) {
  const Points nodes = solution.positions + solution.displacement;
  const Eigen::Vector3d low = nodes.colwise().minCoeff();
  const Eigen::Vector3d high = nodes.colwise().maxCoeff();
  ImageGeometry grid;
  grid.spacing.setConstant(voxel);
  grid.origin = low.array() - voxel;
  grid.size = ((high - low) / voxel).array().ceil().cast<int>() + 3;
  return grid;
}

}  // namespace

std::vector<double> estimated_error_at(const Solution& solution, bool moved, const Points& points) {
  constexpr std::size_t neighbours = 8;
  const Points nodes = moved ? Points(solution.positions + solution.displacement) : solution.positions;
  const PointTree tree(nodes);
  std::vector<double> result(static_cast<std::size_t>(points.rows()));
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    std::array<std::size_t, neighbours> index{};
    std::array<double, neighbours> squared{};
    const auto found = tree.nearest(points.row(i).data(), neighbours, index.data(), squared.data());
    if (std::sqrt(squared[0]) > solution.spacing[index[0]]) {
      continue;
    }
    double sum = 0, weights = 0;
    for (std::size_t n = 0; n < found; ++n) {
      const double weight = 1.0 / (squared[n] + 1e-12);
      sum += weight * solution.estimated_error[index[n]];
      weights += weight;
    }
    result[static_cast<std::size_t>(i)] = sum / weights;
  }
  return result;
}

ScalarImage estimated_error_on(const Solution& solution, bool moved, const ImageGeometry& grid) {
  Points places(static_cast<Eigen::Index>(grid.voxel_count()), 3);
  for (int k = 0; k < grid.size.z(); ++k) {
    for (int j = 0; j < grid.size.y(); ++j) {
      for (int i = 0; i < grid.size.x(); ++i) {
        places.row(static_cast<Eigen::Index>(grid.offset(i, j, k))) =
            grid.to_world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
      }
    }
  }
  const std::vector<double> error = estimated_error_at(solution, moved, places);
  return {grid, std::vector<float>(error.begin(), error.end())};
}

void write_shown_fields(const fs::path& folder, const Solution& solution, const Surface& brain,
                        const VectorImage& forward) {
  write_brain(folder / "brain_intraop.vtp", solution, brain, forward);
  if (!solution.estimated_error.empty()) {
    write_image(folder / "estimated_error.nii.gz", estimated_error_on(solution, true, error_grid(solution)));
  }
}

}  // namespace brainshift::pipelines
