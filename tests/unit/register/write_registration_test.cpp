// SPDX-License-Identifier: GPL-3.0-or-later
// ITK brings an Eigen of its own, which must be read before ours.
#include <gtest/gtest.h>
#include <itkImageFileReader.h>
#include <itkNearestNeighborInterpolateImageFunction.h>
#include <itkNiftiImageIO.h>
#include <itkResampleImageFilter.h>

#include <fstream>
#include <limits>

#include "register/registration.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/files/point_table.hpp"
#include "segmentation/image/itk_bridge.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/register/read_transform.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::write_registration_test {

using namespace builders;
using test::ScratchFolder;

using ItkField = itk::Image<itk::Vector<float, 3>, 3>;

ItkField::Pointer read_field(const std::filesystem::path& file) {
  const auto reader = itk::ImageFileReader<ItkField>::New();
  reader->SetImageIO(itk::NiftiImageIO::New());
  reader->SetFileName(file.string());
  reader->Update();
  return reader->GetOutput();
}

ItkTransform::Pointer transform_of(const ItkField& field) {
  const auto doubles = ItkTransform::DisplacementFieldType::New();
  doubles->CopyInformation(&field);
  doubles->SetRegions(field.GetLargestPossibleRegion());
  doubles->Allocate();
  std::copy(field.GetBufferPointer(), field.GetBufferPointer() + field.GetLargestPossibleRegion().GetNumberOfPixels(),
            doubles->GetBufferPointer());
  const auto transform = ItkTransform::New();
  transform->SetDisplacementField(doubles);
  return transform;
}

template <class T>
Image<T> resample_with_itk(const Image<T>& picture, const ItkTransform* transform, bool nearest) {
  using Itk = ItkImage<T>;
  const typename Itk::Pointer input = seen_by_itk(picture);
  const auto filter = itk::ResampleImageFilter<Itk, Itk>::New();
  filter->SetInput(input);
  filter->SetReferenceImage(input);
  filter->UseReferenceImageOn();
  filter->SetTransform(transform);
  if (nearest) {
    filter->SetInterpolator(itk::NearestNeighborInterpolateImageFunction<Itk, double>::New());
  }
  filter->Update();
  return from_itk<T>(*filter->GetOutput());
}

class RegistrationFiles : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder();
    input_ = new RegisterInput(head(sinking, grid({56, 50, 48}, {1.6, 1.8, 2.0}, oblique())));
    input_->landmarks.resize(2, 3);
    input_->landmarks.row(0) = (centre + Eigen::Vector3d(2, 2, 15)).transpose();
    input_->landmarks.row(1) = (centre + Eigen::Vector3d(200, 0, 0)).transpose();
    registration_ = new Registration(register_images(*input_, {}));
    write_registration(folder_->path(), *registration_);
  }
  static void TearDownTestSuite() {
    delete registration_;
    delete input_;
    delete folder_;
  }

  static void expect_same_resampling(const ItkTransform* transform) {
    ASSERT_NE(transform, nullptr);
    const ScalarImage warped = resample_with_itk(input_->t1, transform, false);
    const LabelMap labels = resample_with_itk(*input_->labels, transform, true);
    double largest = 0;
    std::size_t other_labels = 0;
    for (std::size_t v = 0; v < warped.voxels.size(); ++v) {
      largest = std::max(largest, std::abs(double{warped.voxels[v]} - registration_->warped.voxels[v]));
      other_labels += labels.voxels[v] == registration_->warped_labels->voxels[v] ? 0 : 1;
    }
    EXPECT_LT(largest, 1e-3);     // of 170 grey levels: single precision of the field and the image
    EXPECT_LE(other_labels, 2U);  // a place half-way between two voxels may fall to either
  }

  static inline ScratchFolder* folder_ = nullptr;
  static inline RegisterInput* input_ = nullptr;
  static inline Registration* registration_ = nullptr;
};

TEST_F(RegistrationFiles, AreAllThere) {
  for (const char* name : {"warped.nii.gz", "warped_labels.nii.gz", "intraop_to_preop.nii.gz",
                           "preop_to_intraop.nii.gz", "from-preop_to-intraop_mode-image_xfm.h5",
                           "from-preop_to-intraop_mode-points_xfm.h5", "landmarks.csv", "jacobian.nii.gz"}) {
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_->path() / name)) << name;
  }
}

TEST_F(RegistrationFiles, TheFieldImageIsADisplacementFieldThatItkResamplesWithAsWeDo) {
  expect_same_resampling(transform_of(*read_field(folder_->path() / "intraop_to_preop.nii.gz")));
}

TEST_F(RegistrationFiles, TheTransformIsOneThatItkResamplesWithAsWeDo) {
  expect_same_resampling(read_transform(folder_->path() / "from-preop_to-intraop_mode-image_xfm.h5"));
}

TEST_F(RegistrationFiles, TheForwardTransformMovesPointsAsWeDo) {
  const auto transform = read_transform(folder_->path() / "from-preop_to-intraop_mode-points_xfm.h5");
  ASSERT_NE(transform.GetPointer(), nullptr);
  const Points& nodes = input_->solution.positions;
  const Points moved = move_points(registration_->forward, nodes);
  for (Eigen::Index n = 0; n < nodes.rows(); ++n) {
    const auto by_itk = transform->TransformPoint(nodes.row(n).data());
    for (unsigned axis = 0; axis < 3; ++axis) {
      ASSERT_NEAR(by_itk[axis], moved(n, axis), 1e-4);
    }
  }
}

TEST_F(RegistrationFiles, TheTransformsKeepOnlyTheBoxThatMoves) {
  const auto transform = read_transform(folder_->path() / "from-preop_to-intraop_mode-image_xfm.h5");
  const auto size = transform->GetDisplacementField()->GetLargestPossibleRegion().GetSize();
  EXPECT_LT(size[0] * size[1] * size[2], input_->t1.voxels.size());
}

TEST_F(RegistrationFiles, TheLandmarksNameTheirFrameAndBothPlaces) {
  std::ifstream in(folder_->path() / "landmarks.csv");
  std::string frame, unit, header, row;
  std::getline(in, frame);
  std::getline(in, unit);
  std::getline(in, header);
  EXPECT_EQ(frame, "# frame: LPS");
  EXPECT_EQ(header, "label,x,y,z,intraop_x,intraop_y,intraop_z,ux,uy,uz");
  for (Eigen::Index p = 0; p < 2; ++p) {
    std::getline(in, row);
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream cells(row);
    double number = 0;
    cells >> number;
    EXPECT_EQ(number, p + 1);
    Eigen::Matrix<double, 9, 1> values;
    for (Eigen::Index c = 0; c < 9; ++c) {
      cells >> values[c];
    }
    EXPECT_LT((values.head<3>().transpose() - input_->landmarks.row(p)).norm(), 1e-5);
    EXPECT_LT((values.segment<3>(3).transpose() - registration_->landmarks.row(p)).norm(), 1e-5);
    EXPECT_LT((values.head<3>() + values.tail<3>() - values.segment<3>(3)).norm(), 1e-5);
  }
}

TEST_F(RegistrationFiles, TheLandmarksTellTheEstimatedErrorWhereThereIsOne) {
  Registration registration = *registration_;
  registration.landmark_error = {0.25, std::numeric_limits<double>::quiet_NaN()};
  const ScratchFolder folder;
  write_registration(folder.path(), registration);
  std::ifstream in(folder.path() / "landmarks.csv");
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_TRUE(lines[2].ends_with(",uz,estimated_error"));
  EXPECT_TRUE(lines[3].ends_with(",0.250000"));
  EXPECT_TRUE(lines[4].ends_with(","));
}

TEST_F(RegistrationFiles, TheLandmarksKeepTheirNames) {
  Registration registration = *registration_;
  const auto labels_with = [&](const std::vector<std::string>& names) {
    registration.landmark_names = names;
    const ScratchFolder folder;
    write_registration(folder.path(), registration);
    const PointTable table = read_point_table(folder.path() / "landmarks.csv");
    return texts_in(table, "label");
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(labels_with({"gyrus, \"left\"", "#2"}), (Names{"gyrus, \"left\"", "#2"}));
  EXPECT_EQ(labels_with({"", "tumour"}), (Names{"1", "tumour"}));
  EXPECT_EQ(labels_with({"tumour", "tumour"}), (Names{"1", "2"})) << "two of one name";
  EXPECT_EQ(labels_with({"2", ""}), (Names{"2", "landmark 2"})) << "another is called so";
}

/// What is thrown names the file.
void expect_fault(const std::filesystem::path& folder, const Registration& registration, const std::string& named) {
  try {
    write_registration(folder, registration);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& fault) {
    EXPECT_NE(std::string(fault.what()).find(named), std::string::npos) << fault.what();
  }
}

TEST_F(RegistrationFiles, AFolderThatIsNotThereIsAFaultThatNamesTheFile) {
  expect_fault(folder_->path() / "nowhere", *registration_, "nowhere");
}

TEST_F(RegistrationFiles, AFullDiskIsAFaultThatNamesTheFile) {
  for (const char* name : {"from-preop_to-intraop_mode-points_xfm.h5", "landmarks.csv"}) {
    const ScratchFolder full;
    std::filesystem::create_symlink("/dev/full", full.path() / name);
    expect_fault(full.path(), *registration_, name);
  }
}

}  // namespace brainshift::registration::write_registration_test
