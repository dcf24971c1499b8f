// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/show/shown_fields.hpp"

#include <gtest/gtest.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "segmentation/files/surface_file.hpp"
#include "tests/unit/pipelines/run_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::pipelines::shown_fields_test {

/// A ball of 20 mm that moves by (0, 3, 4) mm; its error grows along z.
class ShownFields : public RunFolder {
 protected:
  ShownFields() {
    forward_.geometry.size.setConstant(31);
    forward_.geometry.spacing.setConstant(2);
    forward_.geometry.origin.setConstant(-30);
    forward_.voxels.assign(forward_.geometry.voxel_count(), {0, 3, 4});
    std::vector<Eigen::RowVector3d> nodes;
    for (int x = -4; x <= 4; ++x) {
      for (int y = -4; y <= 4; ++y) {
        for (int z = -4; z <= 4; ++z) {
          const Eigen::RowVector3d node = 5 * Eigen::RowVector3d(x, y, z);
          if (node.norm() <= 20) {
            nodes.push_back(node);
          }
        }
      }
    }
    solution_.positions.resize(static_cast<Eigen::Index>(nodes.size()), 3);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      solution_.positions.row(static_cast<Eigen::Index>(i)) = nodes[i];
      solution_.estimated_error.push_back(0.5 + 0.01 * nodes[i].z());
    }
    solution_.displacement = Eigen::RowVector3d(0, 3, 4).replicate(solution_.positions.rows(), 1);
    solution_.spacing.assign(nodes.size(), 5);
  }

  vtkSmartPointer<vtkPolyData> brain_of_the_file() const {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder_ / "brain_intraop.vtp").c_str());
    reader->Update();
    return reader->GetOutput();
  }

  const Surface ball_ = brainshift::test::sphere({0, 0, 0}, 20, 3);
  VectorImage forward_;
  Solution solution_;
};

TEST_F(ShownFields, TheBrainLiesWhereItMovedWithTheLengthOfItsDisplacement) {
  write_shown_fields(folder_, solution_, ball_, forward_);
  const Surface warped = read_surface(folder_ / "brain_intraop.vtp");
  EXPECT_TRUE(warped.vertices.isApprox(ball_.vertices.rowwise() + Eigen::RowVector3d(0, 3, 4), 1e-9));
  const auto data = brain_of_the_file();
  ASSERT_NE(data->GetPointData()->GetScalars(), nullptr);
  EXPECT_STREQ(data->GetPointData()->GetScalars()->GetName(), "displacement_mm");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    ASSERT_NEAR(data->GetPointData()->GetScalars()->GetTuple1(i), 5, 1e-9);
    ASSERT_NEAR(data->GetPointData()->GetArray("estimated_error_mm")->GetTuple1(i), 0.5 + 0.01 * ball_.vertices(i, 2),
                0.06);
  }
}

TEST_F(ShownFields, TheErrorIsAnImageOfTheIntraoperativeBrain) {
  write_shown_fields(folder_, solution_, ball_, forward_);
  const ScalarImage error = read_image(folder_ / "estimated_error.nii.gz");
  EXPECT_FLOAT_EQ(error.voxels.front(), 0);
  const auto at = [&](double x, double y, double z) {
    const Eigen::Array3i index = error.geometry.to_index({x, y, z}).array().round().cast<int>();
    return error.at(index.x(), index.y(), index.z());
  };
  EXPECT_NEAR(at(0, 3, 4), 0.5, 0.05);
  EXPECT_NEAR(at(0, 3, 4 + 18), 0.68, 0.05);
  EXPECT_FLOAT_EQ(at(18, 3 + 18, 4 + 18), 0) << "11 mm outside the ball";
}

TEST_F(ShownFields, WithoutAnEstimateThereIsNone) {
  solution_.estimated_error.clear();
  write_shown_fields(folder_, solution_, ball_, forward_);
  EXPECT_EQ(brain_of_the_file()->GetPointData()->GetArray("estimated_error_mm"), nullptr);
  EXPECT_FALSE(fs::exists(folder_ / "estimated_error.nii.gz"));
}

}  // namespace brainshift::pipelines::shown_fields_test
