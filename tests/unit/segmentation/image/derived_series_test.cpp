// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/derived_series.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "segmentation/image/dicom_series.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"
#include "tests/unit/segmentation/image/drawn_dicom.hpp"

namespace brainshift::test::derived_series_test {

const Derivation derivation{.series = "Moved by a test", .description = "Of no use to anybody."};

/// Six slices of an MR of a study and a frame of reference.
struct Source {
  ScratchFolder folder;

  explicit Source(const std::string& modality = "MR", const std::string& study = "1.2.3.8",
                  const std::string& rescale = "") {
    for (int k = 0; k < 6; ++k) {
      DrawnSlice slice;
      slice.modality = modality;
      slice.study = study;
      slice.frame_of_reference = "1.2.3.7";
      slice.rescale = rescale;
      slice.position = "-1\\-2\\" + std::to_string(2 * k);
      folder.write(std::to_string(k) + ".dcm", slice.bytes());
    }
  }
};

/// Values from low to high that are no whole numbers.
ScalarImage ramp(const ImageGeometry& grid, double low, double high) {
  ScalarImage image{grid, std::vector<float>(grid.voxel_count())};
  for (std::size_t i = 0; i < image.voxels.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(image.voxels.size() - 1);
    image.voxels[i] = static_cast<float>(low + (high - low) * part);
  }
  return image;
}

ImageGeometry oblique_grid() {
  ImageGeometry grid = grid_around({12.3456789, -45.678901234, 7.0 / 3}, 5, {0.7, 0.9, 1.1}, oblique());
  grid.size = {6, 5, 4};
  return grid;
}

double farthest(const ScalarImage& a, const ScalarImage& b) {
  double apart = 0;
  for (std::size_t i = 0; i < a.voxels.size(); ++i) {
    apart = std::max(apart, std::abs(double{a.voxels[i]} - b.voxels[i]));
  }
  return apart;
}

TEST(DerivedSeries, ReadAgainHasItsPlaceAndItsValuesToHalfAStep) {
  struct Case {
    const char* what;
    std::string rescale;
    double low, high, step;
  };
  for (const Case& c : {Case{"whole numbers", "", 0, 4000, 1}, Case{"below zero", "", -120, 4000, 1},
                        Case{"16 bits", "", 0, 65535, 1}, Case{"more than 16 bits", "", -20000, 70000, 90000.0 / 65000},
                        Case{"the source's steps", "0.25\\-8", -8, 700, 0.25}}) {
    const Source source("MR", "1.2.3.8", c.rescale);
    const ScratchFolder out;
    const ScalarImage image = ramp(oblique_grid(), c.low, c.high);
    ASSERT_EQ(write_derived_series(out / "made", image, source.folder.path(), derivation), "") << c.what;
    const ScalarImage again = read_image(out / "made");
    EXPECT_TRUE(same_geometry(again.geometry, image.geometry)) << c.what;
    EXPECT_TRUE(again.geometry.origin.isApprox(image.geometry.origin, 1e-12)) << c.what;
    EXPECT_LE(farthest(again, image), 0.5001 * c.step) << c.what;
    EXPECT_GT(farthest(again, image), 0.25 * c.step) << c.what;  // values between two steps are among them
  }
}

TEST(DerivedSeries, IsAnotherSeriesOfTheSamePatientAndStudy) {
  const Source source;
  const ScratchFolder out;
  const ScalarImage image = ramp(oblique_grid(), 0, 1000);
  write_derived_series(out / "made", image, source.folder.path(), derivation);
  const std::string slice = bytes_of(out / "made/0004.dcm");
  for (const char* const held : {"Somebody", "1.2.3.8", "1.2.3.7", "DERIVED\\SECONDARY", "Moved by a test",
                                 "Of no use to anybody.", "1.2.3.5.0", "1.2.3.5.10", "2.25."}) {
    EXPECT_NE(slice.find(held), std::string::npos) << held;
  }
  EXPECT_EQ(slice.find("1.2.3.4"), std::string::npos) << "the source's series";
}

TEST(DerivedSeries, EqualImagesMakeEqualFilesAndOthersHaveOtherNames) {
  const Source source;
  const ScratchFolder out;
  const ScalarImage image = ramp(oblique_grid(), 0, 1000), other = ramp(oblique_grid(), 0, 1001);
  ScalarImage moved = image;
  moved.geometry.origin.x() += 1;
  const auto slice = [&](const std::string& name, const ScalarImage& of) {
    write_derived_series(out / name, of, source.folder.path(), derivation);
    return bytes_of(out / (name + "/0001.dcm"));
  };
  const auto uid = [](const std::string& bytes) { return bytes.substr(bytes.find("2.25."), 40); };
  const std::string first = slice("first", image);
  EXPECT_EQ(slice("again", image), first);
  EXPECT_NE(uid(slice("other", other)), uid(first));
  EXPECT_NE(uid(slice("moved", moved)), uid(first));
}

TEST(DerivedSeries, OfWhatIsNoMrOrHasNoStudyIsNotWritten) {
  const ScratchFolder out;
  const ScalarImage image = ramp(oblique_grid(), 0, 1000);
  EXPECT_NE(write_derived_series(out / "ct", image, Source("CT").folder.path(), derivation).find("no MR"),
            std::string::npos);
  EXPECT_NE(write_derived_series(out / "bare", image, Source("MR", "").folder.path(), derivation).find("study"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(out.path()));
}

}  // namespace brainshift::test::derived_series_test
