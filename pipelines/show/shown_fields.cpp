// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/show/shown_fields.hpp"

#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <array>
#include <cmath>

#include "register/warp/point_mover.hpp"
#include "segmentation/files/refuse.hpp"
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

ScalarImage nodal_image(const Solution& solution, std::span<const double> values) {
  const Points nodes = solution.positions + solution.displacement;
  const Eigen::Vector3d low = nodes.colwise().minCoeff();
  const Eigen::Vector3d high = nodes.colwise().maxCoeff();
  ScalarImage image;
  image.geometry.spacing.setConstant(voxel);
  image.geometry.origin = low.array() - voxel;
  image.geometry.size = ((high - low) / voxel).array().ceil().cast<int>() + 3;
  Points places(static_cast<Eigen::Index>(image.geometry.voxel_count()), 3);
  for (int k = 0; k < image.geometry.size.z(); ++k) {
    for (int j = 0; j < image.geometry.size.y(); ++j) {
      for (int i = 0; i < image.geometry.size.x(); ++i) {
        places.row(static_cast<Eigen::Index>(image.geometry.offset(i, j, k))) =
            image.geometry.to_world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
      }
    }
  }
  const Eigen::Map<const Eigen::VectorXd> nodal(values.data(), static_cast<Eigen::Index>(values.size()));
  const Eigen::VectorXd at_voxels = values_at(solution, nodal, true, places);
  image.voxels.assign(at_voxels.begin(), at_voxels.end());
  return image;
}

}  // namespace

Eigen::MatrixXd values_at(const Solution& solution, const Eigen::MatrixXd& values, bool moved, const Points& points) {
  constexpr std::size_t neighbours = 8;
  const Points nodes = moved ? Points(solution.positions + solution.displacement) : solution.positions;
  const PointTree tree(nodes);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(points.rows(), values.cols());
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    std::array<std::size_t, neighbours> index{};
    std::array<double, neighbours> squared{};
    const auto found = tree.nearest(points.row(i).data(), neighbours, index.data(), squared.data());
    if (std::sqrt(squared[0]) > solution.spacing[index[0]]) {
      continue;
    }
    double weights = 0;
    for (std::size_t n = 0; n < found; ++n) {
      const double weight = 1.0 / (squared[n] + 1e-12);
      result.row(i) += weight * values.row(static_cast<Eigen::Index>(index[n]));
      weights += weight;
    }
    result.row(i) /= weights;
  }
  return result;
}

std::vector<double> estimated_error_at(const Solution& solution, bool moved, const Points& points) {
  const Eigen::Map<const Eigen::VectorXd> nodal(solution.estimated_error.data(),
                                                static_cast<Eigen::Index>(solution.estimated_error.size()));
  const Eigen::VectorXd values = values_at(solution, nodal, moved, points);
  return {values.begin(), values.end()};
}

std::vector<double> read_deviations(const fs::path& file) {
  const auto grid = vtu::read(file);
  const auto nodes = static_cast<std::size_t>(grid->GetNumberOfPoints());
  std::vector<double> values = vtu::array(file, *grid->GetPointData(), "uncertainty", nodes);
  if (values.empty()) {
    refuse(file, "it has no point array `uncertainty`.");
  }
  return values;
}

void write_nodal_image(const fs::path& file, const Solution& solution, std::span<const double> values) {
  write_image(file, nodal_image(solution, values));
}

void write_shown_fields(const fs::path& folder, const Solution& solution, const Surface& brain,
                        const VectorImage& forward) {
  write_brain(folder / "brain_intraop.vtp", solution, brain, forward);
  if (!solution.estimated_error.empty()) {
    write_nodal_image(folder / "estimated_error.nii.gz", solution, solution.estimated_error);
  }
}

}  // namespace brainshift::pipelines
