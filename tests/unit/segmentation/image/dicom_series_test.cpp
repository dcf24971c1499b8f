// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/dicom_series.hpp"

#include <gtest/gtest.h>

#include "segmentation/image/image.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"
#include "tests/unit/segmentation/image/drawn_dicom.hpp"

namespace brainshift::test::dicom_series_test {

std::string slice_name(int k) {
  return "slice" + std::to_string(k) + ".dcm";
}

/// Five slices, 2 mm apart, that of the highest place first; a text lies beside them.
struct Series {
  ScratchFolder folder;

  static DrawnSlice slice(int k) {
    DrawnSlice drawn;
    drawn.value += 100 * static_cast<std::uint64_t>(k);
    drawn.position = "-1\\-2\\" + std::to_string(2 * k);
    return drawn;
  }
  Series() {
    for (int k = 0; k < 5; ++k) {
      put(k, slice(k).bytes());
    }
    folder.write("notes", "Etc/UTC\n");
  }
  void put(int k, const std::string& bytes) { folder.write(slice_name(9 - k), bytes); }
  std::string fault() const {
    return refusal([&] { read_image(folder.path()); });
  }
};

bool says(const std::string& sentence, const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return sentence.find(word) != std::string::npos; });
}

TEST(DicomSeries, IsOneImageInTheOrderOfItsPlaces) {
  const Series series;
  const ScalarImage image = read_image(series.folder.path());
  ASSERT_TRUE((image.geometry.size == Eigen::Array3i(4, 3, 5)).all());
  EXPECT_TRUE(image.geometry.spacing.isApprox(Eigen::Vector3d(0.7, 0.8, 2.0), 1e-6)) << image.geometry.spacing;
  EXPECT_TRUE(image.geometry.origin.isApprox(Eigen::Vector3d(-1, -2, 0), 1e-6));
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(image.at(3, 2, k), static_cast<float>(100 + 100 * k + 3 + 20));
  }
}

TEST(DicomSeries, ASliceCutAnywhereIsNamed) {
  Series series;
  const std::string whole = Series::slice(2).bytes();
  for (const std::size_t length : {whole.size() - 2, whole.size() - 30, whole.size() - 120, std::size_t{300},
                                   std::size_t{140}, std::size_t{132}}) {
    series.put(2, whole.substr(0, length));
    EXPECT_TRUE(says(series.fault(), {"slice7.dcm", "copy it again"})) << length << series.fault();
  }
}

TEST(DicomSeries, ASliceThatDiffersFromTheOthersIsNamed) {
  for (const auto& [name, change] : std::vector<std::pair<std::string, std::function<void(DrawnSlice&)>>>{
           {"Rows", [](DrawnSlice& drawn) { drawn.rows = 4; }},
           {"Columns", [](DrawnSlice& drawn) { drawn.columns = 3; }},
           {"BitsAllocated", [](DrawnSlice& drawn) { drawn.bits = 8; }},
           {"PixelSpacing", [](DrawnSlice& drawn) { drawn.spacing = "0.9\\0.7"; }},
           {"ImageOrientationPatient", [](DrawnSlice& drawn) { drawn.orientation = "0\\1\\0\\1\\0\\0"; }}}) {
    Series series;
    DrawnSlice other = Series::slice(2);
    change(other);
    series.put(2, other.bytes());
    EXPECT_TRUE(says(series.fault(), {"slice7.dcm", name + " is not that of slice5.dcm"})) << series.fault();
  }
}

TEST(DicomSeries, AnOrientationThatIsNoneIsRefused) {
  using namespace std::string_literals;
  for (const std::string& orientation : {"1\\0\\0\\0\n\\0"s, "1\\0\\0\\0\\nan\\0"s, "1\\0\\0\\1\\0\\0"s, "1\\0\\0"s}) {
    Series series;
    for (int k = 0; k < 5; ++k) {
      DrawnSlice drawn = Series::slice(k);
      drawn.orientation = orientation;
      series.put(k, drawn.bytes());
    }
    EXPECT_TRUE(says(series.fault(), {".dcm"})) << orientation << series.fault();
  }
}

TEST(DicomSeries, SlicesThatAreMissingTwiceThereOrShiftedAreRefused) {
  Series gap, twice, tilted;
  std::filesystem::remove(gap.folder / slice_name(7));
  twice.put(7, Series::slice(2).bytes());
  for (int k = 0; k < 5; ++k) {
    DrawnSlice drawn = Series::slice(k);
    drawn.position = "-1\\" + std::to_string(k) + "\\" + std::to_string(2 * k);
    tilted.put(k, drawn.bytes());
  }
  EXPECT_TRUE(says(gap.fault(), {"evenly spaced"}));
  EXPECT_TRUE(says(twice.fault(), {"evenly spaced"}));
  EXPECT_TRUE(says(tilted.fault(), {"shifted"}));
}

TEST(DicomSeries, ALinkToNoFileIsNoSliceThatMayBePassedOver) {
  const Series series;
  std::filesystem::create_symlink(series.folder / "annexed", series.folder / "slice10.dcm");
  EXPECT_TRUE(says(series.fault(), {"slice10.dcm: is a link to no file", "datalad get"})) << series.fault();
}

TEST(DicomSeries, NoneOrTwoInAFolderAreRefused) {
  const ScratchFolder folder;
  folder.write("timezone", "Etc/UTC\n");
  EXPECT_TRUE(says(refusal([&] { read_image(folder.path()); }), {folder.path().string(), "no DICOM"}));
  Series two;
  DrawnSlice other;
  other.series = "1.2.3.9";
  two.put(8, other.bytes());
  EXPECT_TRUE(says(two.fault(), {"exactly one DICOM series", "2"}));
}

/// The slices of Series in one file, stored in an order of their own.
struct Frames {
  ScratchFolder folder;
  std::vector<DrawnSlice> frames;

  Frames() {
    for (const int k : {0, 2, 4, 1, 3}) {
      frames.push_back(Series::slice(k));
    }
  }
  ScalarImage read() const {
    folder.write("frames.dcm", drawn_frames(frames));
    return read_image(folder.path());
  }
  std::string fault() const {
    return refusal([&] { read(); });
  }
};

TEST(DicomSeries, FramesOfOneFileAreTheSameImageInTheOrderOfTheirPlaces) {
  const Series series;
  const ScalarImage slices = read_image(series.folder.path()), frames = Frames().read();
  EXPECT_TRUE(same_geometry(frames.geometry, slices.geometry));
  EXPECT_EQ(frames.voxels, slices.voxels);
}

TEST(DicomSeries, FramesWithoutPlacesAreRefused) {
  Frames frames;
  frames.frames[3].position = "";
  EXPECT_TRUE(says(frames.fault(), {"frames.dcm", "frame 4 has no position"}));
  DrawnSlice drawn;
  drawn.sequence = element(0x28, 8, "IS", "2");
  frames.folder.write("frames.dcm", drawn.header() + element(0x7fe0, 0x10, "OW", drawn.pixels() + drawn.pixels()));
  EXPECT_TRUE(says(refusal([&] { read_image(frames.folder.path()); }), {"frames.dcm", "2 frames", "place of each"}));
}

TEST(DicomSeries, FramesThatAreMissingTwiceThereOrShiftedAreRefused) {
  Frames gap, twice, tilted, turned, rescaled;
  gap.frames.erase(gap.frames.begin() + 1);
  twice.frames.push_back(twice.frames[2]);
  for (std::size_t n = 0; n < 5; ++n) {
    DrawnSlice& frame = tilted.frames[n];
    frame.position.replace(3, 2, std::to_string(0.1 * static_cast<double>(frame.value)));
  }
  turned.frames[1].orientation = "0\\1\\0\\1\\0\\0";
  for (DrawnSlice& frame : rescaled.frames) {
    frame.rescale = std::to_string(frame.value) + "\\0";
  }
  EXPECT_TRUE(says(gap.fault(), {"evenly spaced", "frame"}));
  EXPECT_TRUE(says(twice.fault(), {"evenly spaced", "frame"}));
  EXPECT_TRUE(says(tilted.fault(), {"shifted"}));
  EXPECT_TRUE(says(turned.fault(), {"ImageOrientationPatient of frame 2 is not that of frame 1"}));
  EXPECT_TRUE(says(rescaled.fault(), {"RescaleSlope", "frame 2"}));
}

TEST(DicomSeries, SmallSlopesOfFramesAreToldApart) {
  Frames frames;
  for (DrawnSlice& frame : frames.frames) {
    frame.rescale = "2e-5\\0";
  }
  EXPECT_EQ(frames.fault(), "");
  frames.frames[2].rescale = "4e-5\\0";
  EXPECT_TRUE(says(frames.fault(), {"RescaleSlope", "frame 3"}));
}

TEST(DicomSeries, EnhancedFilesOfOneFrameEachAreASeries) {
  const ScratchFolder folder;
  for (int k = 0; k < 5; ++k) {
    folder.write(slice_name(k), drawn_frames({Series::slice(k)}, true));
  }
  const Series series;
  const ScalarImage slices = read_image(series.folder.path()), frames = read_image(folder.path());
  EXPECT_TRUE(same_geometry(frames.geometry, slices.geometry));
  EXPECT_EQ(frames.voxels, slices.voxels);
}

TEST(DicomSeries, AnEnhancedFileThatTellsAPartOfItsPlaceIsReadByItsGroups) {
  const ScratchFolder folder;
  const std::string bare = drawn_frames({Series::slice(0)}, true);
  const std::size_t samples = bare.find(element(0x28, 2, "US", little_endian(1, 2)));
  folder.write("one.dcm",
               bare.substr(0, samples) + element(0x20, 0x32, "DS", Series::slice(0).position) + bare.substr(samples));
  EXPECT_TRUE(read_image(folder.path()).geometry.origin.isApprox(Eigen::Vector3d(-1, -2, 0), 1e-6));
}

TEST(DicomSeries, AShearOfAFewTenthsOfAMillimetreIsRefused) {
  Series series;
  for (int k = 0; k < 5; ++k) {
    DrawnSlice drawn = Series::slice(k);
    drawn.position = "-1\\" + std::to_string(-2 + 0.06 * k) + "\\" + std::to_string(2 * k);
    series.put(k, drawn.bytes());
  }
  EXPECT_TRUE(says(series.fault(), {"the last by 0.24"})) << series.fault();
}

TEST(DicomSeries, ASegmentationIsSaidToBeOne) {
  Series series;
  DrawnSlice drawn = Series::slice(2);
  drawn.bits = 1;
  series.put(2, drawn.bytes());
  EXPECT_TRUE(says(series.fault(), {"slice7.dcm", "segmentation", ".seg.nrrd"})) << series.fault();
}

TEST(DicomSeries, NestedSequencesArePassedOverAndCutOnesRefused) {
  const std::string unbounded("\xff\xff\xff\xff", 4);
  const std::string begin = little_endian(8, 2) + little_endian(0x1140, 2) + "SQ" + std::string(2, '\0') + unbounded +
                            little_endian(0xfffe, 2) + little_endian(0xe000, 2) + unbounded +
                            element(8, 0x60, "CS", "CT");
  const std::string end = little_endian(0xfffe, 2) + little_endian(0xe00d, 2) + std::string(4, '\0') +
                          little_endian(0xfffe, 2) + little_endian(0xe0dd, 2) + std::string(4, '\0');
  Series series;
  DrawnSlice drawn = Series::slice(2);
  drawn.sequence = begin + end;
  series.put(2, drawn.bytes());
  EXPECT_EQ(series.fault(), "");
  drawn.sequence = begin;
  series.put(2, drawn.bytes());
  EXPECT_TRUE(says(series.fault(), {"slice7.dcm"}));
}

}  // namespace brainshift::test::dicom_series_test
