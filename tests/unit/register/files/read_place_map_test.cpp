// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/read_place_map.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "register/files/transform_files.hpp"
#include "tests/unit/expect_parts.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::read_place_map_test {

using namespace builders;
using test::expect_parts;
using test::refusal;
using test::ScratchFolder;

/// A file as ITK writes it, of these parts.
std::filesystem::path write_tfm(const ScratchFolder& folder, const char* name, const std::vector<std::string>& parts) {
  std::ofstream out(folder.path() / name);
  out << "#Insight Transform File V1.0\n";
  for (const std::string& part : parts) {
    out << "#Transform\n" << part;
  }
  return folder.path() / name;
}

// A quarter turn about z, then a move; and a stretch along x about (1, 0, 0).
constexpr const char* turn =
    "Transform: AffineTransform_double_3_3\nParameters: 0 -1 0 1 0 0 0 0 1 5 6 7\nFixedParameters: 0 0 0\n";
constexpr const char* stretch =
    "Transform: AffineTransform_float_3_3\nParameters: 2 0 0 0 1 0 0 0 1 0 0 0\nFixedParameters: 1 0 0\n";

TEST(ReadPlaceMap, OfTransformsTheLastOfSeveralActsFirst) {
  const ScratchFolder folder;
  const Eigen::Vector3d x(10, -4, 7);
  const PlaceMap one = read_place_map(write_tfm(folder, "turn.tfm", {turn}));
  EXPECT_LT((*one(x) - Eigen::Vector3d(9, 16, 14)).norm(), 1e-9);
  const std::string both = "Transform: CompositeTransform_double_3_3\n";
  const PlaceMap stretch_first = read_place_map(write_tfm(folder, "both.txt", {both, turn, stretch}));
  EXPECT_LT((*stretch_first(x) - Eigen::Vector3d(9, 25, 14)).norm(), 1e-9);
}

TEST(ReadPlaceMap, OfASplineEndsWithItsGrid) {
  const ScratchFolder folder;
  std::string spline = "Transform: BSplineTransform_double_3_3\nParameters:";
  for (int i = 0; i < 3 * 64; ++i) {
    spline += i < 64 ? " 2.5" : " 0";  // those of x first
  }
  spline += "\nFixedParameters: 4 4 4 -10 -10 -10 10 10 10 1 0 0 0 1 0 0 0 1\n";
  const PlaceMap map = read_place_map(write_tfm(folder, "spline.tfm", {spline}));
  EXPECT_LT((*map({4, 5, 3}) - Eigen::Vector3d(6.5, 5, 3)).norm(), 1e-9);
  EXPECT_FALSE(map({100, 0, 0}));
}

TEST(ReadPlaceMap, OfAFieldIsTheSameInAllFormats) {
  const ScratchFolder folder;
  const VectorImage bump = field(grid(), [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(std::exp(-(x - centre).squaredNorm() / 100) * Eigen::Vector3d(0, 1, -4));
  });
  write_transform_files(folder.path(), bump, bump);
  const Eigen::Vector3d x = centre + Eigen::Vector3d(1, 2, 3);
  const double far = 1e4;
  for (const char* name : {"field.nii.gz", "field.nrrd", "field.mha"}) {
    write_image(folder.path() / name, bump);
  }
  const Eigen::Vector3d expected = *read_place_map(folder.path() / "field.nii.gz")(x);
  EXPECT_NEAR((expected - x).norm(), std::sqrt(17.0) * std::exp(-0.14), 0.15);
  for (const std::string name :
       {"field.nrrd", "field.mha", "from-preop_to-intraop_mode-points_xfm.h5",
        "from-preop_to-intraop_mode-image_xfm.h5", "from-preop_to-intraop_mode-image_xfm.nrrd"}) {
    const PlaceMap map = read_place_map(folder.path() / name);
    EXPECT_LT((*map(x) - expected).norm(), 1e-5) << name;
    EXPECT_FALSE(map({far, far, far})) << name;
  }
}

TEST(ReadPlaceMap, OfAFieldIsNotKnownBesideANaN) {
  const ScratchFolder folder;
  VectorImage half = field(grid(), [](const Eigen::Vector3d&) { return Eigen::Vector3d(1, 2, 3); });
  const Eigen::Array3i size = half.geometry.size;
  const auto place = [&](double i) { return half.geometry.to_world({i, size[1] / 2.0, size[2] / 2.0}); };
  for (std::size_t v = 0; v < half.voxels.size(); ++v) {
    if (static_cast<int>(v) % size[0] < size[0] / 2) {
      half.voxels[v][1] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  write_transform_files(folder.path(), half, half);
  for (const std::string name : {"half.nii.gz", "half.mha", "from-preop_to-intraop_mode-points_xfm.h5"}) {
    if (name.starts_with("half")) {
      write_image(folder.path() / name, half);
    }
    const PlaceMap map = read_place_map(folder.path() / name);
    const Eigen::Vector3d x = place(size[0] / 2 + 0.5);
    ASSERT_TRUE(map(x)) << name;
    EXPECT_LT((*map(x) - x - Eigen::Vector3d(1, 2, 3)).norm(), 1e-5) << name;
    EXPECT_FALSE(map(place(size[0] / 2 - 0.5))) << name << ", between one that is known and one that is not";
    EXPECT_FALSE(map(place(1))) << name;
  }
}

TEST(ReadPlaceMap, KnowsTheDirectionByNameOrNote) {
  const ScratchFolder folder;
  EXPECT_EQ(known_direction("a/preop_to_intraop.nii.gz"), Moves::points);
  EXPECT_EQ(known_direction("intraop_to_preop.nii.gz"), Moves::image);
  EXPECT_EQ(known_direction("from-preop_to-intraop_mode-points_xfm.h5"), Moves::points);
  EXPECT_EQ(known_direction("from-preop_to-intraop_mode-image_xfm.nrrd"), Moves::image);
  const auto file = folder.path() / "1Warp.nii.gz";
  EXPECT_FALSE(known_direction(file));
  const auto note = [&](const char* text) { std::ofstream(folder.path() / "1Warp.json") << text; };
  note(R"({"From": "preop", "To": "intraop", "Mode": "image"})");
  EXPECT_EQ(known_direction(file), Moves::image);
  note(R"({"From": "intraop", "To": "preop", "Mode": "image"})");
  EXPECT_FALSE(known_direction(file));
  note("[");
  EXPECT_FALSE(known_direction(file));
}

TEST(ReadPlaceMap, RefusesWhatIsNoMap) {
  const ScratchFolder folder;
  const auto refused = [&](const char* name) { return refusal([&] { read_place_map(folder.path() / name); }); };
  expect_parts(refused("none.h5"), {"none.h5"});
  std::ofstream(folder.path() / "torn.h5") << "\x89HDF\r\n\x1a\n and then nothing";
  testing::internal::CaptureStderr();
  expect_parts(refused("torn.h5"), {"torn.h5: is no ITK transform"});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "HDF5's own words";
  std::ofstream(folder.path() / "torn.tfm") << "#Insight Transform File V1.0\nTransform: Bent_double_3_3\n";
  expect_parts(refused("torn.tfm"), {"torn.tfm: is no ITK transform"});
  const std::string composite = "Transform: CompositeTransform_double_3_3\n";
  write_tfm(folder, "empty.tfm", {composite + "Parameters: \nFixedParameters: \n", turn});  // ITK crashes on it
  expect_parts(refused("empty.tfm"), {"empty.tfm: gives its composite transform the line 'Parameters:'", "take"});
  write_tfm(folder, "fixed.txt", {composite + "FixedParameters: 0 0 0\n", turn});
  expect_parts(refused("fixed.txt"), {"fixed.txt: ", "'FixedParameters:'"});
  std::ofstream(folder.path() / "torn.mat") << "nothing";
  expect_parts(refused("torn.mat"), {"torn.mat: "});
  write_image(folder.path() / "scalar.nii.gz", ScalarImage{grid(), std::vector<float>(grid().voxel_count(), 0.0F)});
  expect_parts(refused("scalar.nii.gz"), {"scalar.nii.gz", "3"});
  VectorImage bad = field(grid(), [](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
  bad.voxels[5][1] = std::numeric_limits<float>::infinity();
  for (const char* name : {"infinite.mha", "infinite.nii.gz"}) {
    write_image(folder.path() / name, bad);
    expect_parts(refused(name), {name, "not finite", "by NaN where the field is not known"});
  }
}

}  // namespace brainshift::registration::read_place_map_test
