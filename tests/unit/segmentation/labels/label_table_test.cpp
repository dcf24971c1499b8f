// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/labels/label_table.hpp"

#include <gtest/gtest.h>

#include "segmentation/interface/options.hpp"

namespace brainshift::test::label_table_test {

using namespace segmentation;

LabelVolumes volumes_of(std::initializer_list<int> numbers) {
  LabelVolumes volumes;
  for (const int number : numbers) {
    volumes[static_cast<std::uint16_t>(number)] = 1000;
  }
  return volumes;
}

TEST(LabelTable, FreeSurfersNumbersHaveTheirClasses) {
  const auto& classes = freesurfer_table().classes;
  for (const std::uint16_t number :
       std::initializer_list<std::uint16_t>{2, 3, 8, 16, 41, 85, 255, 1035, 2035, 3000, 5002, 11100, 12175}) {
    EXPECT_EQ(classes.at(number), default_label::parenchyma) << number;
  }
  for (const std::uint16_t number : std::initializer_list<std::uint16_t>{4, 5, 14, 15, 31, 43, 44, 63, 72, 213, 221}) {
    EXPECT_EQ(classes.at(number), default_label::ventricles) << number;
  }
  EXPECT_EQ(classes.at(24), default_label::csf);
  EXPECT_EQ(classes.at(165), default_label::skull);
  for (const std::uint16_t number : std::initializer_list<std::uint16_t>{1, 6, 258, 507, 2036}) {
    EXPECT_FALSE(classes.contains(number)) << number;
  }
}

TEST(LabelTable, FreeSurfersNumbersAreRecognisedAndNoOthers) {
  EXPECT_TRUE(is_freesurfer(volumes_of({2, 3, 4, 7, 8, 10, 11, 12, 13, 16, 17, 18, 41, 42, 43, 507})));
  EXPECT_TRUE(is_freesurfer(volumes_of({2, 4, 7, 8, 10, 11, 12, 13, 41, 1001, 2035})));
  EXPECT_FALSE(is_freesurfer(volumes_of({2, 4, 7, 8, 10, 11, 12, 13, 41}))) << "no cortex";
  EXPECT_FALSE(is_freesurfer(volumes_of({1, 2, 3, 4, 5, 6})));
  EXPECT_FALSE(is_freesurfer(volumes_of({1, 2, 3, 4, 7, 8, 10, 11, 12, 13, 16, 17, 18, 41, 42}))) << "has 1";
  EXPECT_FALSE(is_freesurfer(volumes_of({2, 3, 41, 42})));
  EXPECT_FALSE(is_freesurfer({}));
}

TEST(LabelTable, VolumesCountEveryNumberButZero) {
  LabelMap map{{.size = {2, 2, 1}, .spacing = {1, 2, 3}}, {0, 7, 65535, 7}};
  EXPECT_EQ(label_volumes(map), (LabelVolumes{{7, 12.0}, {65535, 6.0}}));
}

TEST(LabelTable, NumbersWithoutAnEntryStayOrBecomeBackground) {
  LabelMap map{{.size = {3, 1, 1}}, {2, 40000, 65535}};
  LabelMap other = map;
  renumber(map, {{2, 1}, {40000, 1}}, Unnamed::stay);
  EXPECT_EQ(map.voxels, (std::vector<std::uint16_t>{1, 1, 65535}));
  renumber(other, {{2, 1}, {40000, 1}}, Unnamed::become_background);
  EXPECT_EQ(other.voxels, (std::vector<std::uint16_t>{1, 1, 0}));
}

TEST(LabelTable, UnknownNumbersAreListedTheLargestFirst) {
  EXPECT_EQ(unknown_labels({{2, 9000.0}, {136, 1440.0}, {507, 20000.0}}, freesurfer_table()),
            "507 (20 ml), 136 (1.4 ml)");
  EXPECT_EQ(unknown_labels({{2, 9000.0}}, freesurfer_table()), "");
}

TEST(LabelTable, BratsHasTumourAndOedema) {
  EXPECT_EQ(find_label_table("brats").classes,
            (std::map<std::uint16_t, std::uint16_t>{{1, 3}, {2, 1}, {3, 3}, {4, 3}}));
  EXPECT_EQ(find_label_table("freesurfer").classes, freesurfer_table().classes);
}

}  // namespace brainshift::test::label_table_test
